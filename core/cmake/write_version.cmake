# Writes version.cpp from its template; an unchanged result leaves the file, and the build, alone.
# Run by every build: cmake -D SOURCE_DIR=... -D TEMPLATE=... -D OUTPUT=... -P write_version.cmake
set(ENV{GIT_OPTIONAL_LOCKS} 0)  # do not disturb other git commands
cmake_path(GET SOURCE_DIR PARENT_PATH above)
set(ENV{GIT_CEILING_DIRECTORIES} "${above}")  # an archive inside of another repository has no commit
execute_process(
  COMMAND git -c safe.directory=* describe --always --dirty --abbrev=40 --exclude=*
  WORKING_DIRECTORY "${SOURCE_DIR}"
  OUTPUT_VARIABLE DRAPE_GIT_COMMIT
  OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET)
if(NOT DRAPE_GIT_COMMIT)
  set(DRAPE_GIT_COMMIT "unknown")
endif()
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
