// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "nscdd/error.h"
#include "results/result_tables.h"
#include "results/results_folder.h"

namespace nscdd {

/// A folder that vanishes after the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("nscdd_") + test->test_suite_name() + "_" + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string TextOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string SentenceOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline RunIdentity IdentityOf(const std::string& scene) { return {scene, scene + ".toml", "0", "0.1.0", {{"steps", "3"}}}; }

/// Three free disks in a row and a prescribed body of one segment and one disk below them; ids not in order.
inline GrainTable SampleGrains() {
  GrainTable grains;
  grains.id = {30, 7, 9, 40};
  grains.x = {5.0, 1.0, 3.0, 3.0};
  grains.y = {1.0, 1.0, 1.0, 0.0};
  grains.angle = {0.1, 0.2, -0.3, 0.0};
  grains.vx = {0.0, 1.0 / 3.0, -2.0, 0.0};
  grains.vy = {0.0, 0.5, 0.0, 0.0};
  grains.spin = {1e-300, 0.0, -0.0, 0.0};
  grains.radius = {1.0, 1.0, 1.0, 0.5};
  grains.multiplicity = {1, 2, 3, 0};
  grains.subdomain = {0, 0, 1, 0};
  grains.kind = {0, 0, 0, 1};
  return grains;
}

inline ContactRows SampleContacts() {
  ContactRows contacts;
  contacts.body_a = {7, 9, 9};
  contacts.body_b = {9, 30, 40};
  contacts.shape_a = {0, 0, 0};
  contacts.shape_b = {0, 0, 1};
  contacts.image = {0, 0, 0};
  contacts.gap = {-0.01, 0.02, 0.0};
  contacts.final_gap = {-0.02, 0.01, 0.0};
  contacts.normal_x = {1.0, 1.0, 0.0};
  contacts.normal_y = {0.0, 0.0, -1.0};
  contacts.point_x = {2.0, 4.0, 3.0};
  contacts.point_y = {1.0, 1.0, 0.0};
  contacts.lever_a = {1.0, 1.0, 1.0};
  contacts.lever_b = {1.0, 1.0, 0.0};
  contacts.impulse_n = {2.0, 0.0, 1.0};
  contacts.impulse_t = {0.1, 0.0, -0.2};
  contacts.force_n = {8.0, 0.0, 4.0};  // in steps of 0.25 s
  contacts.force_t = {0.4, 0.0, -0.8};
  contacts.force_x = {8.0, 0.0, 0.8};
  contacts.force_y = {-0.4, 0.0, -4.0};
  contacts.velocity_n = {0.0, 0.3, 0.0};
  contacts.velocity_t = {0.0, 0.0, 0.1};
  contacts.status = {1, 0, 2};
  contacts.subdomain = {0, 1, 1};
  return contacts;
}

inline ShapeTable SampleShapes() {
  ShapeTable shapes;
  shapes.body = {40, 40};
  shapes.kind = {ShapeKind::kDisk, ShapeKind::kSegment};
  shapes.x0 = {0.0, -4.0};
  shapes.y0 = {-0.5, 0.0};
  shapes.x1 = {0.0, 4.0};
  shapes.y1 = {0.0, 0.0};
  shapes.radius = {0.5, 0.0};
  return shapes;
}

}  // namespace nscdd
