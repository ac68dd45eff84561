# Installs the build to a folder, moves it, and lets a project that knows only that folder build,
# link and test. The folder stays where something failed, for people to look at.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set(OUTSIDE ${CMAKE_CURRENT_LIST_DIR}/outside)
set(PREFIX ${WORK}/prefix)
# Whoever runs this may have set it; the scenes are to be those of the prefix.
unset(ENV{SHADOWPROOF_SCENES})

function(configure EXPECTED FOLDER)
    run(${EXPECTED} ${CMAKE_COMMAND} -S ${OUTSIDE} -B ${FOLDER} -G ${GENERATOR}
        -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} -DCMAKE_BUILD_TYPE=${CONFIG}
        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${COMPILER_FLAGS}
        -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_PREFIX_PATH=${PREFIX})
    set(output "${output}" PARENT_SCOPE)
endfunction()

# The package may be moved: nothing in it names the folder of the installation.
function(install_and_move)
    run(0 ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${WORK}/installed)
    file(RENAME ${WORK}/installed ${PREFIX})
endfunction()

function(outside_project_builds_and_its_tests_pass)
    configure(0 ${WORK}/build)
    run(0 ${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})
    run(0 ${CTEST} --test-dir ${WORK}/build -C ${CONFIG} --output-on-failure)
    expect_in("${output}" "0 tests failed out of 8")
    run(0 ${CTEST} --test-dir ${WORK}/build -C ${CONFIG} -N -L shadowproof)
    expect_in("${output}" "Total Tests: 11")
endfunction()

# CTest is content with any failure; it has to be this one.
function(the_test_that_fails_does_so_for_its_shadows)
    file(READ ${WORK}/build/shadowproof/differs/results.json results)
    string(JSON passed GET "${results}" passed)
    expect_same("${passed}" OFF)
    string(JSON cause GET "${results}" scenes 0 techniques 0 first cause)
    expect_same("${cause}" near_plane)
    foreach(folder shadowproof/ordinary shadowproof/excused shadowproof/allowed "the report")
        file(READ "${WORK}/build/${folder}/results.json" results)
        string(JSON passed GET "${results}" passed)
        expect_same("${passed}" ON)
    endforeach()
endfunction()

# The words of the command that a test of the outside project runs.
function(command_of TEST RESULT)
    run(0 ${CTEST} --test-dir ${WORK}/build -C ${CONFIG} --show-only=json-v1)
    string(JSON count LENGTH "${output}" tests)
    math(EXPR last "${count} - 1")
    foreach(test RANGE ${last})
        string(JSON name GET "${output}" tests ${test} name)
        if(NOT name STREQUAL TEST)
            continue()
        endif()
        set(words)
        string(JSON length LENGTH "${output}" tests ${test} command)
        math(EXPR end "${length} - 1")
        foreach(word RANGE ${end})
            string(JSON text GET "${output}" tests ${test} command ${word})
            list(APPEND words "${text}")
        endforeach()
    endforeach()
    set(${RESULT} "${words}" PARENT_SCOPE)
endfunction()

function(every_argument_reaches_the_command)
    command_of(every_argument words)
    expect_same("${words}" "${PREFIX}/${BIN}/shadowproof;verify;${OUTSIDE}/scenes/court.glb;\
--technique;zpass,zfail;--size;96x64;--camera;from above;--light;1;--time;1.5;\
--gate;differences;--allow;near_plane=12;--allow;precision;\
--baseline;${OUTSIDE}/expected/results.json;--out;${WORK}/build/reports/court")
    command_of(a_model words)
    expect_same("${words}" "${PREFIX}/${BIN}/shadowproof;verify;${OUTSIDE}/models/dog.md2;\
--out;${WORK}/build/shadowproof/a_model")
    command_of(check_argument words)
    expect_same("${words}" "${PREFIX}/${BIN}/shadowproof;check;${OUTSIDE}/scenes/court.glb;\
--renderer;'my program' 'it'\\''s' '{out}';--name;mine;--size;96x64;--camera;1;--allow;near_plane=12;\
--out;${WORK}/build/shadowproof/check_argument")
    command_of(check_picture words)
    expect_same("${words}" "${PREFIX}/${BIN}/shadowproof;check;${OUTSIDE}/scenes/court.glb;\
${WORK}/build/mine.png;--unlit;${WORK}/build/off.png;--out;${WORK}/build/shadowproof/check_picture")
endfunction()

function(refuses CALL WORDS)
    refuses_of(shadowproof_add_test "${CALL}" "${WORDS}")
endfunction()

function(refuses_of FUNCTION CALL WORDS)
    file(GLOB_RECURSE file ${PREFIX}/*/${FUNCTION}.cmake)
    run(refused ${CMAKE_COMMAND} -DFILE=${file} -DFUNCTION=${FUNCTION} -DCALL=${CALL}
        -P ${CMAKE_CURRENT_LIST_DIR}/wrong_call.cmake)
    expect_in("${output}" "${WORDS}")
endfunction()

function(wrong_calls_are_refused_by_name)
    refuses("SCENE ordinary" "NAME is missing; write")
    refuses("NAME one" "shadowproof_add_test(one): SCENE is missing; write")
    refuses("NAME one SCENE" "SCENE is missing; write")
    refuses("NAME one SCENE ordinary TOLERANCE 3" "'TOLERANCE 3' is not known; it takes")
    refuses("NAME one SCENE ordinary far_plane" "'far_plane' is not known; it takes")
    refuses("NAME one SCENE ordinary SIZE ALLOW" "no value follows ALLOW, SIZE; give one")
    refuses("NAME one SCENE ordinary GATE all" "GATE 'all' is not known; give defects or")
    set(check shadowproof_add_check)
    refuses_of(${check} "NAME one SCENE ordinary" "RENDERER or PICTURE is missing; write")
    refuses_of(${check} "NAME one SCENE a b PICTURE c.png" "a PICTURE is of one SCENE; add a test")
    refuses_of(${check} "NAME one SCENE a RENDERER b PICTURE c" "has a RENDERER and a PICTURE")
    refuses_of(${check} "NAME one RENDERER b {out}" "shadowproof_add_check(one): SCENE is missing")
endfunction()

function(a_missing_dependency_is_named)
    set(ENV{PKG_CONFIG_LIBDIR} ${WORK}/nothing)
    configure(refused ${WORK}/without_dependency)
    unset(ENV{PKG_CONFIG_LIBDIR})
    expect_in("${output}" "pkg-config does not find osmesa, which shadowproof links; install")
endfunction()

# A scene of the prefix is changed, and the command's answer with it: it looks there, and not in
# the sources, which have a scene of that name too.
function(the_command_finds_its_scenes_beside_itself)
    set(render ${PREFIX}/${BIN}/shadowproof render --size 96x64)
    run(0 ${render} ordinary -o ${WORK}/ordinary.png)
    run(0 ${render} near_plane -o ${WORK}/near_plane.png)
    file(COPY_FILE ${PREFIX}/${SCENES}/near_plane.gltf ${PREFIX}/${SCENES}/ordinary.gltf)
    run(0 ${render} ordinary -o ${WORK}/changed.png)
    run(0 ${CMAKE_COMMAND} -E compare_files ${WORK}/changed.png ${WORK}/near_plane.png)
    run(1 ${CMAKE_COMMAND} -E compare_files ${WORK}/changed.png ${WORK}/ordinary.png)
endfunction()

# Where programs load what OpenImageIO does for them: the command beside itself, whoever links the
# libraries by the path in which their package lies.
function(openimageio_is_found_in_the_package)
    file(GLOB_RECURSE libraries ${PREFIX}/*libshadowproof_openimageio.so)
    list(LENGTH libraries count)
    expect_same(${count} 1)
    set(debug ${CMAKE_COMMAND} -E env LD_DEBUG=files SHADOWPROOF_SCENES=${PREFIX}/${SCENES})
    run(0 ${debug} ${PREFIX}/${BIN}/shadowproof render ordinary --size 8x8 -o ${WORK}/truth.exr)
    expect_in("${output}" "calling init: ${libraries}")
    run(0 ${debug} ${WORK}/build/counts)
    expect_in("${output}" "calling init: ${libraries}")
    foreach(other draco pcx) # found in the same way, beside it
        string(REPLACE openimageio ${other} beside "${libraries}")
        if(NOT EXISTS ${beside})
            message(FATAL_ERROR "${beside} is not installed")
        endif()
    endforeach()
endfunction()

# Where man and bash look for them, and as the command prints them.
function(manual_page_and_completion_are_installed)
    foreach(file man/man1/shadowproof.1:--man-page bash-completion/completions/shadowproof:--completion)
        string(REPLACE ":" ";" file ${file})
        list(GET file 0 path)
        list(GET file 1 flag)
        run(0 ${PREFIX}/${BIN}/shadowproof ${flag})
        file(READ ${PREFIX}/share/${path} installed)
        expect_same("${installed}" "${output}")
    endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK})
install_and_move()
manual_page_and_completion_are_installed()
outside_project_builds_and_its_tests_pass()
the_test_that_fails_does_so_for_its_shadows()
every_argument_reaches_the_command()
wrong_calls_are_refused_by_name()
a_missing_dependency_is_named()
openimageio_is_found_in_the_package()
the_command_finds_its_scenes_beside_itself()
file(REMOVE_RECURSE ${WORK})
