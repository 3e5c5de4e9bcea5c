# Compile options of all targets of the project. The same bits on every machine: no contraction of
# a product and a sum into one rounding. Visual C++ 2022 contracts only where /fp:contract says so.
function(msq_compile_options target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "^(GNU|Clang|AppleClang)$" AND NOT MSVC)
    target_compile_options(${target} PRIVATE -Wall -Wextra -ffp-contract=off)
    if(MSQ_WERROR)
      target_compile_options(${target} PRIVATE -Werror)
    endif()
  elseif(MSVC)
    target_compile_options(${target} PRIVATE /W3 /utf-8 /fp:precise)
    # The names of the C library without underscores, and std::min next to <windows.h>.
    target_compile_definitions(${target} PRIVATE _CRT_SECURE_NO_WARNINGS NOMINMAX)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      target_compile_options(${target} PRIVATE /clang:-ffp-contract=off)
    else()
      target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:/Zc:__cplusplus /bigobj>)
    endif()
    if(MSQ_WERROR)
      target_compile_options(${target} PRIVATE /WX)
    endif()
  else()
    message(WARNING "msq: ${CMAKE_CXX_COMPILER_ID} is not known. Results are exact only without "
                    "contraction of floating-point expressions; add the option for that.")
  endif()
  if(MSQ_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(MSQ_SANITIZE_THREADS)
    target_compile_options(${target} PRIVATE -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=thread)
  endif()
  if(MSQ_BUILD_FUZZERS)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# A shared library exports its functions and nothing else, not even templates of the standard
# library: what the files `names`.map and `names`.exports list. On Windows only what its header marks
# is exported.
function(msq_export_only_api target names)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY" OR WIN32)
    return()
  endif()
  if(APPLE)
    set(list ${names}.exports)
    target_link_options(${target} PRIVATE "LINKER:-exported_symbols_list,${list}")
  elseif(UNIX)
    set(list ${names}.map)
    target_link_options(${target} PRIVATE "LINKER:--version-script=${list}" "LINKER:--no-undefined")
  endif()
  set_target_properties(${target} PROPERTIES LINK_DEPENDS ${list})
endfunction()

# Compile options of those of the files that include a header, in sanitized builds.
function(msq_lighten header options)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} found REGEX "^#include <${header}" LIMIT_COUNT 1)
    if(MSQ_SANITIZE AND found)
      set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "${options}"
                                                     SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# Compiles those sources of a target that lie in one folder as one file. By themselves stay files that Highway
# compiles once for each instruction set, files with CGAL, and, by CMake, files with options of their own.
function(msq_unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} found REGEX "^#include <(hwy/foreach_target|CGAL/)" LIMIT_COUNT 1)
    if(NOT found)
      get_filename_component(folder ${file} DIRECTORY)
      file(RELATIVE_PATH folder ${CMAKE_CURRENT_SOURCE_DIR}/src ${folder})
      string(REPLACE "/" "_" folder ${folder})
      set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${folder})
    endif()
  endforeach()
endfunction()

# Compiles headers of the standard library once and not with each C++ source of a target (MSQ_PRECOMPILE), or takes
# those of another target with the same options.
function(msq_precompile target)
  if(MSQ_PRECOMPILE AND ARGC GREATER 1)
    target_precompile_headers(${target} REUSE_FROM ${ARGV1})
  elseif(MSQ_PRECOMPILE)
    list(TRANSFORM MSQ_COMMON_HEADERS REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>" OUTPUT_VARIABLE headers)
    target_precompile_headers(${target} PRIVATE ${headers})
  endif()
  # Without it, Clang's file differs each time, and a compiler cache finds nothing that was compiled with it.
  if(MSQ_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>)
  endif()
endfunction()
set(MSQ_COMMON_HEADERS algorithm array atomic bit cmath cstdint cstring functional limits map memory mutex
                       numeric optional set string utility vector)
