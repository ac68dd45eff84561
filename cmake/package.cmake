# cpack: two Debian packages, shadowproof (the command, its scenes, manual and documents) and
# shadowproof-dev (what other projects build and test with).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME shadowproof)
set(CPACK_PACKAGE_VENDOR "the shadowproof authors")
set(SHADOWPROOF_PACKAGE_MAINTAINER "the shadowproof authors <shadowproof@localhost>" CACHE STRING
    "Who answers for a package that cpack makes: NAME <ADDRESS>")
set(CPACK_PACKAGE_CONTACT "${SHADOWPROOF_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME shadowproof)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON) # what the program and its modules are linked with
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS libegl1) # loaded by --gl egl alone
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Judges the shadows of a renderer: each pixel by exact arithmetic, each wrong one by its cause.")

# What cmake/shadowproof-config.cmake.in asks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME shadowproof-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "shadowproof (= ${PROJECT_VERSION}), pkg-config, \
libembree-dev, libtbb-dev, libglm-dev, libtinygltf-dev, nlohmann-json3-dev, libfmt-dev, libpng-dev, \
libosmesa6-dev, libgmp-dev, libxxhash-dev, libdeflate-dev, libhwy-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Libraries, headers and a CMake package, with which other projects test their shadows.")
include(CPack)
