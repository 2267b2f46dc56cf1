# The libraries Lorica stands on; packaging/setup.sh installs them.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(embree REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(Threads REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore FiltersGeneral IOLegacy IOXML IOXMLParser)
# Headers of a baseline that `lorica-cli bench` measures against, where they are.
find_path(LORICA_CGAL_INCLUDE CGAL/AABB_tree.h)
# Of the window alone; LoricaVtkQt says when it is not here.
find_package(meshoptimizer QUIET)

if(LORICA_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
endif()
