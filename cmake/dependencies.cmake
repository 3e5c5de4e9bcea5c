# The libraries that msq stands on. Debian: libtbb-dev libhwy-dev, and for the optional parts
# libassimp-dev libminizip-dev libpugixml-dev (binary STL, 3MF, AMF), libcgal-dev (foam method 2),
# libxxhash-dev (hashes), nlohmann-json3-dev (documents), libtiff-dev (TIFF in documents).
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MSQ_HWY REQUIRED IMPORTED_TARGET libhwy)

if(MSQ_WITH_ASSIMP)
  find_package(assimp REQUIRED)
  find_package(pugixml REQUIRED)
  find_package(ZLIB REQUIRED)
  pkg_check_modules(MSQ_MINIZIP REQUIRED IMPORTED_TARGET minizip)
endif()
if(MSQ_WITH_XXHASH)
  # Used as a header alone, from version 0.8.0 on (Debian: libxxhash-dev).
  find_path(MSQ_XXHASH_INCLUDE xxhash.h REQUIRED)
endif()
if(MSQ_WITH_JSON)
  # Headers alone (Debian: nlohmann-json3-dev).
  find_path(MSQ_JSON_INCLUDE nlohmann/json.hpp REQUIRED)
endif()
if(MSQ_WITH_TIFF)
  # From 4.5 on a file has handlers of its own for what goes wrong, and a limit of its memory.
  find_package(TIFF 4.5 REQUIRED)
endif()
if(MSQ_WITH_CGAL)
  # CGAL's own package file sets build flags for everything; only its headers and GMP are wanted.
  find_path(MSQ_CGAL_INCLUDE CGAL/Delaunay_triangulation_3.h REQUIRED)
  find_library(MSQ_GMP gmp REQUIRED)
  find_library(MSQ_MPFR mpfr REQUIRED)
  set(MSQ_LICENCE "GPL-3.0-or-later")
else()
  set(MSQ_LICENCE "Apache-2.0")
endif()

# Private to msq: no type of a dependency crosses the C ABI, so hosts need none of their headers.
function(msq_link_dependencies target)
  target_link_libraries(${target} PRIVATE Threads::Threads TBB::tbb PkgConfig::MSQ_HWY)
  if(MSQ_WITH_ASSIMP)
    target_link_libraries(${target} PRIVATE assimp::assimp pugixml::pugixml PkgConfig::MSQ_MINIZIP
                                            ZLIB::ZLIB)
  endif()
  if(MSQ_WITH_TIFF)
    target_link_libraries(${target} PRIVATE TIFF::TIFF)
  endif()
  if(MSQ_WITH_CGAL)
    target_link_libraries(${target} PRIVATE ${MSQ_GMP} ${MSQ_MPFR})
  endif()
endfunction()
