include(CMakeFindDependencyMacro)
find_dependency(msq 0.1)
include(${CMAKE_CURRENT_LIST_DIR}/hostTargets.cmake)
