# Debian packages by CPack, one for each component of install.cmake: ninefold, ninefold-client (without the
# window's libraries), ninefold-common. All are of one release: a master refuses clients of another.
# scripts/package makes them. What they depend on is found by dpkg-shlibdeps on the system that they are made on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ninefold)
set(CPACK_PACKAGE_CONTACT "The authors of Ninefold <ninefold@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "interactive global illumination on a cluster of ordinary computers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL master client common)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_MASTER_PACKAGE_NAME ninefold)
set(CPACK_DEBIAN_CLIENT_PACKAGE_NAME ninefold-client)
set(CPACK_DEBIAN_COMMON_PACKAGE_NAME ninefold-common)
set(CPACK_DEBIAN_COMMON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_COMMON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_MASTER_PACKAGE_SUGGESTS "openssh-client, avahi-daemon")
set(CPACK_DEBIAN_CLIENT_PACKAGE_SUGGESTS avahi-daemon)
set(CPACK_DEBIAN_CLIENT_PACKAGE_CONTROL_EXTRA
  ${CMAKE_SOURCE_DIR}/packaging/postinst ${CMAKE_SOURCE_DIR}/packaging/prerm)
set(CPACK_COMPONENT_MASTER_DESCRIPTION
  "Renders scenes (glTF, OBJ) on a cluster, in a window or into files.")
set(CPACK_COMPONENT_CLIENT_DESCRIPTION
  "Renders for a master elsewhere; needs no display. Comes with ninefold-doctor.")
set(CPACK_COMPONENT_COMMON_DESCRIPTION "Scenes to try, and pages for users and operators.")

foreach(package ninefold ninefold-client ninefold-common)
  string(REPLACE "ninefold-" "" component ${package})
  string(REPLACE ninefold master component ${component})
  install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component})
endforeach()

# The version is that of the moment: package_version.cmake asks for it when packages are made.
set(CPACK_NINEFOLD_SOURCE ${CMAKE_SOURCE_DIR})
set(CPACK_NINEFOLD_VERSION ${PROJECT_VERSION})
set(CPACK_NINEFOLD_GIT ${GIT_EXECUTABLE})
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/cmake/package_version.cmake)
include(CPack)
