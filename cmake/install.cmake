# cmake --install: the command, the libraries with their headers in the folders of the house, the
# bundled scenes, and a CMake package: find_package(shadowproof), targets shadowproof::compare and
# shadowproof::shadowproof, functions shadowproof_add_test and shadowproof_add_check. Of two
# components: program, and development, which needs the program.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/shadowproof)
set(scenes_folder ${CMAKE_INSTALL_DATADIR}/shadowproof/scenes)

install(TARGETS shadowproof EXPORT shadowproof RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS shadowproof_scenes shadowproof_reference shadowproof_raster shadowproof_compare
    EXPORT shadowproof ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(TARGETS shadowproof_draco shadowproof_openimageio shadowproof_pcx
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/shadowproof)
install(EXPORT shadowproof NAMESPACE shadowproof:: DESTINATION ${package_folder}
    FILE shadowproof-targets.cmake COMPONENT development)
foreach(room scenes reference raster compare)
    install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/shadowproof
        COMPONENT development FILES_MATCHING PATTERN "*.h"
        PATTERN bundled EXCLUDE PATTERN command EXCLUDE PATTERN viewer EXCLUDE
        PATTERN glsl EXCLUDE PATTERN techniques EXCLUDE)
endforeach()
install(DIRECTORY scenes/bundled/ DESTINATION ${scenes_folder}
    FILES_MATCHING PATTERN "*.gltf" PATTERN "*.glb" PATTERN "*.bin" PATTERN "costs.json"
    PATTERN author EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/shadowproof.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_BINARY_DIR}/shadowproof.bash RENAME shadowproof
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES docs/results.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/shadowproof)
# Where the README and they themselves link to them.
install(FILES docs/bench.md docs/bench.png docs/bench.schema.json docs/filtering.png
    docs/check.md docs/ci.md docs/claims.md docs/families.md
    docs/house.md docs/how-it-decides.md docs/install.md docs/lighting.md docs/reliability.md
    docs/drivers.md docs/recipes.md docs/report.md docs/results.md docs/scenes.md docs/sensitivity.md
    docs/slurm.md docs/stress.md
    docs/stress-claims.md docs/stress.schema.json docs/techniques.md docs/github-actions.yml
    docs/Containerfile
    docs/manifest.schema.json docs/results.schema.json docs/overview.png docs/cell.png
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
install(FILES docs/recipes/three.mjs docs/recipes/povray.mjs docs/recipes/ogre.py
    DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs/recipes)
install(PROGRAMS docs/recipes/slurm.sh DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs/recipes)
install(FILES docs/results/near_plane.svg docs/results/thin_caster.svg docs/results/idle_casters.svg
    docs/results/walking_figure.svg DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs/results)

configure_package_config_file(cmake/shadowproof-config.cmake.in
    ${CMAKE_BINARY_DIR}/shadowproof-config.cmake INSTALL_DESTINATION ${package_folder}
    PATH_VARS scenes_folder)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/shadowproof-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/shadowproof-config.cmake
    ${CMAKE_BINARY_DIR}/shadowproof-config-version.cmake
    cmake/shadowproof_add_check.cmake cmake/shadowproof_add_test.cmake
    cmake/shadowproof_call.cmake DESTINATION ${package_folder} COMPONENT development)
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)
