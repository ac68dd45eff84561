# What the tests of packages share.

# run(EXPECTED COMMAND...): expects an exit code (or "refused": any but 0); output lands in `output`.
function(run EXPECTED)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT code STREQUAL EXPECTED AND NOT (EXPECTED STREQUAL refused AND NOT code EQUAL 0))
        list(JOIN ARGN " " command)
        message(NOTICE "${text}") # by itself, because CMake breaks the lines of its errors
        message(FATAL_ERROR "ended with ${code}, not ${EXPECTED}: ${command}")
    endif()
    set(output "${text}" PARENT_SCOPE)
endfunction()

function(expect_in TEXT WORDS)
    # CMake breaks the lines of its messages.
    string(REGEX REPLACE "[ \n]+" " " flat "${TEXT}")
    string(FIND "${flat}" "${WORDS}" place)
    if(place EQUAL -1)
        message(NOTICE "${TEXT}")
        message(FATAL_ERROR "'${WORDS}' is not in it")
    endif()
endfunction()

function(expect_same ACTUAL EXPECTED)
    if(NOT ACTUAL STREQUAL EXPECTED)
        message(FATAL_ERROR "is not as expected\n  ${ACTUAL}\n  ${EXPECTED}")
    endif()
endfunction()
