# Debian packages by CPack, in a build by the preset `packages`: scripts/test_packages builds and tests
# them. A build with CGAL gives the library's package another name, libmsq-cgal0, which stands in for
# libmsq0; the other packages are the same for both.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME msq)
set(CPACK_PACKAGE_VENDOR msq)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "maintainers of msq <maintainers@msq.invalid>" CACHE STRING
    "Maintainer of the packages: name and address")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}/tools/io)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# CMake leaves 0775 to the umask of whoever builds.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
                                                GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# SOURCE_DATE_EPOCH names another date.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
# Without a summary of all packages, each has the first line of its own description.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "msq tells which points of a part are solid that is filled with strut
lattices, Voronoi foams or surfaces such as gyroids, slices it layer by
layer, casts rays and measures. Its memory does not grow with the part.
")
set(version "(= ${PROJECT_VERSION})")
set(soversion ${PROJECT_VERSION_MAJOR})
set(library libmsq${soversion})

# A package of a component: its name, the first line and the rest of its description, and what it
# depends on beside what dpkg-shlibdeps finds.
function(msq_package component name summary text depends)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${about}\n${text}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  # What Debian's policy wants in the folder of each package.
  set(folder ${PROJECT_BINARY_DIR}/debian/${name})
  configure_file(packaging/debian/changelog.in ${folder}/changelog @ONLY)
  find_program(MSQ_GZIP gzip)
  mark_as_advanced(MSQ_GZIP)
  if(MSQ_GZIP)
    execute_process(COMMAND ${MSQ_GZIP} -9nf ${folder}/changelog)
  endif()
  install(FILES ${folder}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  install(FILES packaging/debian/${copyright} RENAME copyright DESTINATION share/doc/${name}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(CPACK_COMPONENTS_ALL "")
set(copyright copyright)
if(MSQ_WITH_CGAL)
  set(copyright copyright-cgal)
  msq_package(msq_runtime libmsq-cgal${soversion}
              "lattices and foams inside a part - library with CGAL"
              "This package has the shared library with CGAL: foam method 2 and the count\nof self-intersections of meshes. CGAL places it under the GPL." "")
  set(CPACK_DEBIAN_MSQ_RUNTIME_PACKAGE_PROVIDES "${library} ${version}")
  set(CPACK_DEBIAN_MSQ_RUNTIME_PACKAGE_CONFLICTS ${library})
  set(CPACK_DEBIAN_MSQ_RUNTIME_PACKAGE_REPLACES ${library})
else()
  msq_package(msq_runtime ${library} "lattices and foams inside a part - library"
              "This package has the shared library, without parts under the GPL." "")
  if(MSQ_BUILD_TOOLS)
    msq_package(msq_io_runtime libmsq-io${soversion}
                "lattices and foams inside a part - files for printers"
                "This package has the library that writes PNG stacks, SL1 archives, SVG, 3MF\nand meshes." "${library} ${version}")
    set(io ", libmsq-io${soversion} ${version}")
  endif()
  if(TARGET msq_command)
    msq_package(msq_tools msq-tools "lattices and foams inside a part - command"
                "This package has the command msq, which slices, draws, measures and\nsamples parts." "${library} ${version}${io}")
    set(CPACK_DEBIAN_MSQ_TOOLS_PACKAGE_SECTION graphics)
  endif()
  msq_package(msq_development libmsq-dev "lattices and foams inside a part - development"
              "This package has what programs in C and C++ are built with." "${library} ${version}${io}")
  set(CPACK_DEBIAN_MSQ_DEVELOPMENT_PACKAGE_SECTION libdevel)
  if(MSQ_PYTHON_INSTALL_DIR)
    msq_package(msq_python python3-msq "lattices and foams inside a part - Python 3"
                "This package has the module msq for Python 3." "${library} ${version}, python3, python3-numpy")
    set(CPACK_DEBIAN_MSQ_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_MSQ_PYTHON_PACKAGE_ARCHITECTURE all)
    set(CPACK_DEBIAN_MSQ_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/postinst
                                                      ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
  endif()
endif()
foreach(library IN ITEMS MSQ_RUNTIME MSQ_IO_RUNTIME)
  set(CPACK_DEBIAN_${library}_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
endforeach()
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/compress_manuals.cmake)
include(CPack)
