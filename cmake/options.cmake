# Compile options of all targets of the project.
function(msq_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra)
  # The same bits on every machine: no contraction into fused multiply-adds.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(MSQ_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(MSQ_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
endfunction()

# Compile options of those of the files that include a header, in sanitized builds.
function(msq_lighten header options)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} found REGEX "^#include <${header}" LIMIT_COUNT 1)
    if(MSQ_SANITIZE AND found)
      set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "${options}")
    endif()
  endforeach()
endfunction()
