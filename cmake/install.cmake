# What `cmake --install` puts where, in three components, which package.cmake makes packages of:
#
#   master   ninefold-master and what belongs beside it (the window's libraries come along)
#   client   ninefold-client, ninefold-doctor, the systemd unit
#   common   scenes and pages, for any processor
#
# A program's man page and bash completion are made of its own --help at the end of a build; the page
# needs help2man.
include(GNUInstallDirs)
find_program(NINEFOLD_HELP2MAN help2man)
if(NOT NINEFOLD_HELP2MAN)
  message(STATUS "help2man is not installed: no man pages")
endif()
set(completions ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# The man page of a program: `made_of` is what is asked for --help and --version.
function(ninefold_page component name about made_of)
  if(NOT NINEFOLD_HELP2MAN)
    return()
  endif()
  set(page ${CMAKE_BINARY_DIR}/pages/${name}.1.gz)
  add_custom_command(OUTPUT ${page}
    COMMAND ${NINEFOLD_HELP2MAN} --no-info --name=${about} --output=${name}.1 ${made_of}
    COMMAND gzip -9nf ${name}.1
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/pages DEPENDS ${made_of} COMMENT "" VERBATIM)
  add_custom_target(page-${name} ALL DEPENDS ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()

function(ninefold_completion component name)
  set(file ${CMAKE_BINARY_DIR}/completions/${name})
  add_custom_command(OUTPUT ${file}
    COMMAND sh -c "\"$0\" --help | awk -v program=\"$1\" -f \"$2\" > \"$1\""
      $<TARGET_FILE:${name}> ${name} ${CMAKE_SOURCE_DIR}/cmake/completion.awk
    WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/completions
    DEPENDS ${name} ${CMAKE_SOURCE_DIR}/cmake/completion.awk COMMENT "" VERBATIM)
  add_custom_target(completion-${name} ALL DEPENDS ${file})
  install(FILES ${file} DESTINATION ${completions} COMPONENT ${component})
endfunction()

function(ninefold_install component name about)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
  ninefold_page(${component} ${name} ${about} $<TARGET_FILE:${name}>)
  ninefold_completion(${component} ${name})
endfunction()

file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/pages ${CMAKE_BINARY_DIR}/completions)
ninefold_install(master ninefold-master "renders a scene on a cluster of clients")
ninefold_install(master ninefold-compare "tells how far a picture is from another one")
ninefold_install(master ninefold-replay-task "does one task of a run once more")
ninefold_install(client ninefold-client "renders for a ninefold-master")
ninefold_install(client ninefold-doctor "tells whether this machine can join a ninefold-master")

# Folders of systemd are the same under any prefix but the system's own.
install(FILES packaging/ninefold-client@.service DESTINATION lib/systemd/system COMPONENT client)
install(FILES packaging/ninefold-client.conf DESTINATION lib/sysusers.d COMPONENT client)

install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ninefold/scenes COMPONENT common
  FILES_MATCHING PATTERN "*.glb" PATTERN "*.json" PATTERN "README.md"
  PATTERN generator EXCLUDE)
install(PROGRAMS scripts/slurm DESTINATION ${CMAKE_INSTALL_DATADIR}/ninefold COMPONENT common)
install(FILES README.md docs/browser.md docs/cluster.md docs/light-units.md docs/script.md docs/window.md
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ninefold-common COMPONENT common)
