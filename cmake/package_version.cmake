# The version of packages, when CPack makes them. A later commit has a later version:
#
#   0.1.0+20261130.094831.1f0c25aa9b3e~deb12     the commit's time (UTC) and hash; Debian's version
#   0.1.0+20261130.094831.1f0c25aa9b3e.dirty~deb12    something differs from the commit
#   0.1.0~deb12                                  no checkout (a tarball)
set(ENV{TZ} UTC)
function(git variable)
  set(${variable} "" PARENT_SCOPE)
  if(CPACK_NINEFOLD_GIT)
    execute_process(COMMAND ${CPACK_NINEFOLD_GIT} --no-optional-locks -c safe.directory=* ${ARGN}
      WORKING_DIRECTORY ${CPACK_NINEFOLD_SOURCE} OUTPUT_VARIABLE said ERROR_QUIET
      OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(${variable} "${said}" PARENT_SCOPE)
  endif()
endfunction()

set(version ${CPACK_NINEFOLD_VERSION})
git(commit log -1 --format=%cd.%h --date=format-local:%Y%m%d.%H%M%S --abbrev=12)
if(commit)
  string(APPEND version +${commit})
  git(changes status --porcelain --untracked-files=no)
  if(changes)
    string(APPEND version .dirty)
  endif()
endif()
file(STRINGS /etc/os-release release REGEX "^(ID|VERSION_ID)=")
string(REGEX MATCH "VERSION_ID=\"?([0-9]+)" number "${release}")
if(number)
  string(APPEND version ~deb${CMAKE_MATCH_1})
endif()

set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_DEBIAN_PACKAGE_VERSION ${version})
set(CPACK_DEBIAN_CLIENT_PACKAGE_DEPENDS "ninefold-common (= ${version})")
set(CPACK_DEBIAN_MASTER_PACKAGE_DEPENDS
  "ninefold-client (= ${version}), ninefold-common (= ${version})")
