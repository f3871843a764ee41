// SPDX-License-Identifier: Apache-2.0
/* Prints the first line of the MPI library's version; allowed without MPI_Init. */
#include <mpi.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  char version[MPI_MAX_LIBRARY_VERSION_STRING + 1] = "";
  int length = 0;
  if (MPI_Get_library_version(version, &length) != MPI_SUCCESS) return 1;
  version[strcspn(version, "\r\n")] = '\0';
  for (char* c = version; *c != '\0'; ++c) {
    if (*c == '"' || *c == '\\' || *c == '\t' || *c == ';') *c = ' ';
  }
  printf("%s", version);
  return 0;
}
