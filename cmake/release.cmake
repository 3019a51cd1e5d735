# Writes the release's name into a source file, at each build; the file changes only if the name does.
#
#   cmake -DSOURCE=<tree> -DVERSION=<0.1.0> -DTEMPLATE=<file.in> -DOUTPUT=<file> [-DGIT=<git>] -P release.cmake
#
#   0.1.0+1f0c25aa9b3e                    the commit
#   0.1.0+1f0c25aa9b3e-dirty.5d41402a     and a digest of what differs from it in the folders that programs
#                                         are built from
#   0.1.0+files.5d41402abc4b              no git, no commit yet, or no checkout (a tarball): a digest of all
#                                         files in these folders
#
# The commit's hash and no tag: clones may have unlike tags. Whoever builds a tree trusts it, so that its
# owner need not be who builds. Git looks into this tree and into none around it, whatever a hook that runs
# this build has set.

set(parts CMakeLists.txt cmake common proto client master tools)
unset(ENV{GIT_DIR})
unset(ENV{GIT_WORK_TREE})
unset(ENV{GIT_INDEX_FILE})
get_filename_component(around ${SOURCE} DIRECTORY)
set(ENV{GIT_CEILING_DIRECTORIES} ${around})

# git(VARIABLE ARGUMENT...): what git says; VARIABLE is unset if it fails.
function(git variable)
  unset(${variable} PARENT_SCOPE)
  if(NOT GIT)
    return()
  endif()
  execute_process(
    COMMAND ${GIT} --no-optional-locks -c safe.directory=* -c core.quotePath=true ${ARGN}
    WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(status EQUAL 0)
    set(${variable} "${said}" PARENT_SCOPE)
  endif()
endfunction()

# What differs from the commit, as text; empty if nothing does.
function(describe_differences variable)
  git(changed diff HEAD --binary --no-color --no-ext-diff --no-textconv -- ${parts})
  git(added ls-files --others --exclude-standard -- ${parts})
  set(text "${changed}")
  if(added)
    string(REPLACE "\n" ";" files "${added}")
    foreach(file IN LISTS files)
      set(digest unread)
      if(EXISTS ${SOURCE}/${file})
        file(SHA256 ${SOURCE}/${file} digest)
      endif()
      string(APPEND text "\n${file} ${digest}")
    endforeach()
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# All files, as text.
function(describe_files variable)
  set(files "")
  foreach(part IN LISTS parts)
    if(IS_DIRECTORY ${SOURCE}/${part})
      file(GLOB_RECURSE some LIST_DIRECTORIES false RELATIVE ${SOURCE} ${SOURCE}/${part}/*)
      list(APPEND files ${some})
    elseif(EXISTS ${SOURCE}/${part})
      list(APPEND files ${part})
    endif()
  endforeach()
  list(SORT files)
  set(text "")
  foreach(file IN LISTS files)
    file(SHA256 ${SOURCE}/${file} digest)
    string(APPEND text "${file} ${digest}\n")
  endforeach()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

set(RELEASE ${VERSION})
git(commit rev-parse --verify HEAD)
if(commit)
  string(SUBSTRING ${commit} 0 12 commit)
  string(APPEND RELEASE "+${commit}")
  describe_differences(differences)
  if(NOT differences STREQUAL "")
    string(SHA256 digest "${differences}")
    string(SUBSTRING ${digest} 0 8 digest)
    string(APPEND RELEASE "-dirty.${digest}")
  endif()
else()
  describe_files(files)
  string(SHA256 digest "${files}")
  string(SUBSTRING ${digest} 0 12 digest)
  string(APPEND RELEASE "+files.${digest}")
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
