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

function(shadowproof_add_test)
    set(values NAME SCENE SIZE CAMERA LIGHT TIME GATE BASELINE OUT)
    set(lists TECHNIQUES ALLOW)
    cmake_parse_arguments(PARSE_ARGV 0 given "" "${values}" "${lists}")
    set(call "shadowproof_add_test(${given_NAME})")
    foreach(argument NAME SCENE)
        if("${given_${argument}}" STREQUAL "")
            message(FATAL_ERROR "${call}: ${argument} is missing; write "
                "shadowproof_add_test(NAME name SCENE scene.gltf)")
        endif()
    endforeach()
    if(DEFINED given_UNPARSED_ARGUMENTS)
        list(JOIN given_UNPARSED_ARGUMENTS " " unknown)
        list(JOIN values ", " all)
        message(FATAL_ERROR "${call}: '${unknown}' is not known; it takes one value each for ${all}, "
            "and any number for TECHNIQUES, ALLOW")
    endif()
    if(DEFINED given_KEYWORDS_MISSING_VALUES)
        list(JOIN given_KEYWORDS_MISSING_VALUES ", " empty)
        message(FATAL_ERROR "${call}: no value follows ${empty}; give one, or leave the word out")
    endif()
    if(DEFINED given_GATE AND NOT given_GATE MATCHES "^(defects|differences)$")
        message(FATAL_ERROR "${call}: GATE '${given_GATE}' is not known; give defects or differences")
    endif()

    # Other names are bundled scenes.
    if(given_SCENE MATCHES "\\.([gG][lL][tT][fF]|[gG][lL][bB]|[mM][dD]2)$")
        cmake_path(ABSOLUTE_PATH given_SCENE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    endif()
    if(NOT DEFINED given_OUT)
        set(given_OUT shadowproof/${given_NAME})
    endif()
    cmake_path(ABSOLUTE_PATH given_OUT BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})

    set(arguments ${given_SCENE})
    if(DEFINED given_TECHNIQUES)
        list(JOIN given_TECHNIQUES "," techniques)
        list(APPEND arguments --technique ${techniques})
    endif()
    foreach(argument SIZE CAMERA LIGHT TIME GATE)
        if(DEFINED given_${argument})
            string(TOLOWER ${argument} flag)
            list(APPEND arguments --${flag} ${given_${argument}})
        endif()
    endforeach()
    foreach(allowance IN LISTS given_ALLOW)
        list(APPEND arguments --allow ${allowance})
    endforeach()
    if(DEFINED given_BASELINE)
        cmake_path(ABSOLUTE_PATH given_BASELINE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
        list(APPEND arguments --baseline ${given_BASELINE})
    endif()

    add_test(NAME ${given_NAME}
        COMMAND shadowproof::shadowproof verify ${arguments} --out ${given_OUT})
    set_tests_properties(${given_NAME} PROPERTIES LABELS shadowproof)
endfunction()

cmake_policy(POP)
