/// Writes the median man as bytes, for the build to put into the program: make_median_human FILE. Code 2 without a
/// file, 5 when it cannot be written.

#include <exception>

#include "lorica/base/files.h"
#include "lorica/manikin/human.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  try {
    lorica::base::writeFileAtomically(argv[1], lorica::manikin::humanBytes(lorica::manikin::makeHuman({}, {})));
  } catch (const std::exception&) {
    return 5;
  }
  return 0;
}
