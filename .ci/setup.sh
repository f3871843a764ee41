# SPDX-License-Identifier: Apache-2.0
# Sourced by demo.sh and test.sh, from the project's root: what both need before they can start.

debian_packages=(
  g++ cmake ninja-build ccache pkg-config
  libopenmpi-dev openmpi-bin
  libeigen3-dev libmumps-dev libfmt-dev libbox2d-dev
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev
  libhdf5-openmpi-dev liblzma-dev libcairo2-dev fonts-dejavu-core
  libgtest-dev libbenchmark-dev gnuplot-nox
  libfclib-dev libsiconos-numerics-dev
  python3 python3-h5py
  clang-format codespell
)

# mpirun as root, and with more ranks than cores, which then have to give way to each other.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1

# Installs the Debian packages that are missing; asks apt nothing when none is.
install_packages() {
  local missing=() package
  for package in "${debian_packages[@]}"; do
    if ! dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed; then
      missing+=("$package")
    fi
  done
  if ((${#missing[@]} == 0)); then return; fi

  local as_root=(env)
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "These Debian packages are missing: ${missing[*]}. Install them, or run this as root or with sudo installed." >&2
      exit 1
    fi
    as_root=(sudo env)
  fi
  echo "Installing Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}

# Configures and builds the preset $1 with all cores; asan-fast is a part of asan. Clones in different folders share the
# compiler cache.
build() {
  export CCACHE_BASEDIR=$PWD
  cmake --preset "${1%-fast}"
  cmake --build --preset "$1" --parallel "$(nproc)"
}
