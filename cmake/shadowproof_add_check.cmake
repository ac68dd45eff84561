# shadowproof_add_check: a CTest test that fails where a renderer's shadows of a scene are wrong.
#
#   shadowproof_add_check(
#       NAME name                     # of the test
#       SCENE scene...                # .gltf, .glb or .md2, relative to the current source folder,
#                                     # or names of bundled scenes; one, if there is a PICTURE
#       RENDERER word...              # makes a picture of each scene: a program and its arguments,
#                                     # with {scene}, {view}, {out} and perhaps {unlit}, {unshadowed}
#       | PICTURE image...            # that is there when the test runs, relative to the current
#                                     # build folder
#       [UNLIT image] [UNSHADOWED image] | [MASK image]
#                                     # of a PICTURE, likewise
#       [RENDERER_NAME name]          # in the report: NAME
#       [SIZE WIDTHxHEIGHT]           # of the renderer's pictures: 512x512
#       [CAMERA name] [LIGHT name]    # names or indices in the file; the first
#       [TIME seconds]                # at which animations are posed
#       [GATE defects|differences]    # what fails the test: defects
#       [ALLOW cause[=pixels]...]     # what does not fail it
#       [BASELINE results.json]       # of an earlier run, or accepted, relative to the current
#                                     # source folder
#       [OUT folder])                 # of the report, relative to the current build folder;
#                                     # shadowproof/name
#
# The test has the label `shadowproof`.
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/shadowproof_call.cmake)

# A command of words that hold together whatever is in them.
function(shadowproof_quoted result)
    set(quoted)
    foreach(word IN LISTS ARGN)
        string(REPLACE "'" "'\\''" word "${word}")
        list(APPEND quoted "'${word}'")
    endforeach()
    list(JOIN quoted " " command)
    set(${result} "${command}" PARENT_SCOPE)
endfunction()

function(shadowproof_add_check)
    set(values NAME UNLIT UNSHADOWED MASK RENDERER_NAME SIZE CAMERA LIGHT TIME GATE BASELINE OUT)
    set(lists SCENE RENDERER PICTURE ALLOW)
    set(required NAME SCENE)
    cmake_parse_arguments(PARSE_ARGV 0 given "" "${values}" "${lists}")
    set(call "shadowproof_add_check(${given_NAME})")
    set(example "shadowproof_add_check(NAME name SCENE scene.gltf RENDERER program {scene} {view} {out})")
    shadowproof_require_call("${call}" "${example}")
    if(DEFINED given_RENDERER AND DEFINED given_PICTURE)
        message(FATAL_ERROR "${call}: has a RENDERER and a PICTURE; a picture is there, or is made")
    elseif(NOT DEFINED given_RENDERER AND NOT DEFINED given_PICTURE)
        message(FATAL_ERROR "${call}: RENDERER or PICTURE is missing; write ${example}")
    endif()

    set(arguments)
    foreach(scene IN LISTS given_SCENE)
        shadowproof_scene_path(path ${scene})
        list(APPEND arguments ${path})
    endforeach()
    list(LENGTH given_SCENE scenes)
    if(DEFINED given_PICTURE AND scenes GREATER 1)
        message(FATAL_ERROR "${call}: a PICTURE is of one SCENE; add a test for each")
    endif()
    foreach(picture IN LISTS given_PICTURE)
        cmake_path(ABSOLUTE_PATH picture BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
        list(APPEND arguments ${picture})
    endforeach()
    foreach(argument UNLIT UNSHADOWED MASK)
        if(DEFINED given_${argument})
            cmake_path(ABSOLUTE_PATH given_${argument} BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
            string(TOLOWER ${argument} flag)
            list(APPEND arguments --${flag} ${given_${argument}})
        endif()
    endforeach()
    if(DEFINED given_RENDERER)
        if(NOT DEFINED given_RENDERER_NAME)
            set(given_RENDERER_NAME ${given_NAME})
        endif()
        shadowproof_quoted(command ${given_RENDERER})
        list(APPEND arguments --renderer ${command} --name ${given_RENDERER_NAME})
    endif()
    shadowproof_common_flags()

    add_test(NAME ${given_NAME} COMMAND shadowproof::shadowproof check ${arguments})
    set_tests_properties(${given_NAME} PROPERTIES LABELS shadowproof)
endfunction()

cmake_policy(POP)
