# CPack runs this before it makes packages of the staged files: Debian's policy wants manual pages
# compressed, without the time in them.
file(GLOB_RECURSE manuals ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*.1)
list(FILTER manuals INCLUDE REGEX "/share/man/")
foreach(manual IN LISTS manuals)
  execute_process(COMMAND gzip -9n ${manual} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
