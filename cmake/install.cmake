# Installs the library, its C header, the C++ header over it, the CMake package and the pkg-config file,
# and msq_io likewise. A shared msq
# keeps its dependencies to itself; a static one hands them on to whoever links it.
# Components, for `cmake --install build --component NAME`: msq_runtime and msq_io_runtime, the libraries;
# msq_development, what programs are built with; msq_tools, the command; msq_python; msq_licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(MSQ_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/msq)
set(MSQ_PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(NOT BUILD_SHARED_LIBS AND MSQ_WITH_CGAL)
  # The installed package names GMP and MPFR, not where they stood on the machine that built it.
  get_target_property(MSQ_LINKS msq INTERFACE_LINK_LIBRARIES)
  foreach(lib IN ITEMS GMP MPFR)
    string(TOLOWER ${lib} name)
    string(REPLACE "${MSQ_${lib}}" "$<BUILD_INTERFACE:${MSQ_${lib}}>$<INSTALL_INTERFACE:${name}>"
           MSQ_LINKS "${MSQ_LINKS}")
  endforeach()
  set_target_properties(msq PROPERTIES INTERFACE_LINK_LIBRARIES "${MSQ_LINKS}")
endif()

install(TARGETS msq EXPORT msqTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT msq_runtime
                NAMELINK_COMPONENT msq_development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT msq_development
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT msq_runtime
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES include/msq.h bindings/cpp/msq.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT msq_development)
# Not CMAKE_INSTALL_DOCDIR, which is the host's where msq is a part of another project.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/msq COMPONENT msq_licence)
install(EXPORT msqTargets NAMESPACE msq:: DESTINATION ${MSQ_CMAKE_DIR} COMPONENT msq_development)

if(MSQ_BUILD_TOOLS)
  install(TARGETS msq_io EXPORT msqIoTargets
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT msq_io_runtime
                  NAMELINK_COMPONENT msq_development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT msq_development
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT msq_io_runtime
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(FILES include/msq_io.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT msq_development)
  install(EXPORT msqIoTargets NAMESPACE msq:: DESTINATION ${MSQ_CMAKE_DIR} COMPONENT msq_development)
endif()

configure_package_config_file(cmake/msqConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/msqConfig.cmake
                              INSTALL_DESTINATION ${MSQ_CMAKE_DIR}
                              NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# The ABI is frozen with 0.2 (docs/abi.md).
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/msqConfigVersion.cmake
                                 VERSION ${PROJECT_VERSION}
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/msqConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/msqConfigVersion.cmake
        DESTINATION ${MSQ_CMAKE_DIR} COMPONENT msq_development)

# pkg-config asks for the files of Requires.private even for --cflags, so a shared msq lists none.
set(MSQ_PC_REQUIRES_PRIVATE "")
set(MSQ_PC_LIBS_PRIVATE "")
if(NOT BUILD_SHARED_LIBS)
  set(MSQ_PC_REQUIRES_PRIVATE tbb libhwy)
  if(MSQ_WITH_ASSIMP)
    list(APPEND MSQ_PC_REQUIRES_PRIVATE assimp pugixml minizip zlib)
  endif()
  if(MSQ_WITH_TIFF)
    list(APPEND MSQ_PC_REQUIRES_PRIVATE libtiff-4)
  endif()
  if(MSQ_WITH_CGAL)
    list(APPEND MSQ_PC_REQUIRES_PRIVATE mpfr gmp)
  endif()
  list(JOIN MSQ_PC_REQUIRES_PRIVATE ", " MSQ_PC_REQUIRES_PRIVATE)
  # The C++ runtime, which a C compiler does not link by itself.
  set(MSQ_PC_LIBS_PRIVATE ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  if(CMAKE_C_IMPLICIT_LINK_LIBRARIES) # where C is among the languages
    list(REMOVE_ITEM MSQ_PC_LIBS_PRIVATE ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
  endif()
  list(TRANSFORM MSQ_PC_LIBS_PRIVATE PREPEND "-l")
  list(APPEND MSQ_PC_LIBS_PRIVATE ${CMAKE_THREAD_LIBS_INIT})
  list(JOIN MSQ_PC_LIBS_PRIVATE " " MSQ_PC_LIBS_PRIVATE)
endif()

# Directories relative to the .pc file, so that an installed tree may be moved.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(MSQ_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH MSQ_PC_PREFIX "/prefix/${MSQ_PC_DIR}" "/prefix")
  string(REGEX REPLACE "/$" "" MSQ_PC_PREFIX "\${pcfiledir}/${MSQ_PC_PREFIX}")
endif()
foreach(dir IN ITEMS LIBDIR INCLUDEDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    set(MSQ_PC_${dir} "${CMAKE_INSTALL_${dir}}")
  else()
    set(MSQ_PC_${dir} "\${prefix}/${CMAKE_INSTALL_${dir}}")
  endif()
endforeach()
configure_file(cmake/msq.pc.in ${CMAKE_CURRENT_BINARY_DIR}/msq.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/msq.pc DESTINATION ${MSQ_PC_DIR}
        COMPONENT msq_development)

if(MSQ_BUILD_TOOLS)
  set(MSQ_PC_REQUIRES_PRIVATE "")
  if(NOT BUILD_SHARED_LIBS)
    set(MSQ_PC_REQUIRES_PRIVATE "libpng, zlib, minizip")
    if(MSQ_WITH_ISAL)
      string(APPEND MSQ_PC_REQUIRES_PRIVATE ", libisal")
    endif()
  endif()
  configure_file(cmake/msq_io.pc.in ${CMAKE_CURRENT_BINARY_DIR}/msq_io.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/msq_io.pc DESTINATION ${MSQ_PC_DIR}
          COMPONENT msq_development)
endif()
