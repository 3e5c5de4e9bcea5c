# Tests that this build has not, and why. cmake/summary.cmake prints the list and writes it to left_out.txt in the
# build folder; tests/report/left_out.py adds what CTest skipped.
function(msq_left_out what why)
  set_property(GLOBAL APPEND PROPERTY MSQ_LEFT_OUT "${what}: ${why}")
endfunction()

# Sets `result` to why programs that load the library at run time cannot be tested in this build, or to nothing.
function(msq_unloadable result)
  set(why "")
  if(NOT BUILD_SHARED_LIBS)
    set(why "the library is static")
  elseif(MSQ_SANITIZE)
    set(why "the library is sanitized")
  endif()
  set(${result} "${why}" PARENT_SCOPE)
endfunction()
