# cmake -DFILE=shadowproof_add_test.cmake -DFUNCTION=name -DCALL=arguments -P wrong_call.cmake: a call that is
# refused before any test is added, which a script cannot do.
include(${FILE})
cmake_language(EVAL CODE "${FUNCTION}(${CALL})")
