/// Writes the median man as bytes, for the build to put into the program.

#include <cstdio>
#include <exception>

#include "lorica/base/files.h"
#include "lorica/manikin/human.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_median_human FILE\n");
    return 2;
  }
  try {
    lorica::base::writeFileAtomically(argv[1], lorica::manikin::humanBytes(lorica::manikin::makeHuman({}, {})));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_median_human: %s\n", error.what());
    return 5;
  }
  return 0;
}
