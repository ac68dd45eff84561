# shadowproof_add_test: a CTest test that fails where the shadows of a scene are wrong.
#
#   shadowproof_add_test(
#       NAME name                     # of the test
#       SCENE scene                   # a .gltf, .glb or .md2, relative to the current source
#                                     # folder, or the name of a bundled scene
#       [TECHNIQUES technique...]     # all of them
#       [SIZE WIDTHxHEIGHT]           # 512x512
#       [CAMERA name] [LIGHT name]    # names or indices in the file; the first
#       [TIME seconds]                # at which animations are posed
#       [GATE defects|differences]    # what fails the test: defects
#       [ALLOW cause[=pixels]...]     # what does not fail it
#       [BASELINE results.json]       # of an earlier run, relative to the current source folder
#       [OUT folder])                 # of the report, relative to the current build folder;
#                                     # shadowproof/name
#
# The test has the label `shadowproof`.
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/shadowproof_call.cmake)

function(shadowproof_add_test)
    set(values NAME SCENE SIZE CAMERA LIGHT TIME GATE BASELINE OUT)
    set(lists TECHNIQUES ALLOW)
    set(required NAME SCENE)
    cmake_parse_arguments(PARSE_ARGV 0 given "" "${values}" "${lists}")
    shadowproof_require_call("shadowproof_add_test(${given_NAME})"
        "shadowproof_add_test(NAME name SCENE scene.gltf)")

    shadowproof_scene_path(scene ${given_SCENE})
    set(arguments ${scene})
    if(DEFINED given_TECHNIQUES)
        list(JOIN given_TECHNIQUES "," techniques)
        list(APPEND arguments --technique ${techniques})
    endif()
    shadowproof_common_flags()

    add_test(NAME ${given_NAME}
        COMMAND shadowproof::shadowproof verify ${arguments})
    set_tests_properties(${given_NAME} PROPERTIES LABELS shadowproof)
endfunction()

cmake_policy(POP)
