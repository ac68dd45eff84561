# arrows.cmake passes the sources of the house, and fails on a copy of them with one fault. SOURCE: the
# sources; WORK: a folder for copies.
cmake_minimum_required(VERSION 3.25)

function(copy_house)
    file(REMOVE_RECURSE ${WORK})
    foreach(room scenes reference raster compare)
        file(COPY ${SOURCE}/${room} DESTINATION ${WORK} FILES_MATCHING
            PATTERN "*.h" PATTERN "*.cpp" PATTERN CMakeLists.txt)
    endforeach()
endfunction()

# expect(WORDS): the arrows say so of the copy; nothing: they pass it.
function(expect)
    execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${WORK} -P ${CMAKE_CURRENT_LIST_DIR}/arrows.cmake
        RESULT_VARIABLE code ERROR_VARIABLE said)
    string(REGEX REPLACE "[ \n]+" " " said "${said}")
    string(REPLACE ";" " " words "${ARGN}")
    string(FIND "${said}" "${words}" at)
    if(NOT ARGN)
        if(NOT code EQUAL 0)
            message(SEND_ERROR "the sources do not pass: ${said}")
        endif()
    elseif(code EQUAL 0 OR at EQUAL -1)
        message(SEND_ERROR "expected \"${words}\" (${code}): ${said}")
    endif()
endfunction()

# Adds an include to a file of the copy.
function(add_include FILE INCLUDED)
    file(APPEND ${WORK}/${FILE} "#include \"${INCLUDED}\"\n")
endfunction()

# Lets a folder of the copy include another.
function(permit FOLDER OTHER)
    file(READ ${WORK}/${FOLDER}/CMakeLists.txt text)
    string(REGEX REPLACE "(^|\n)# May include:" "\\1# May include: ${OTHER}" text "${text}")
    file(WRITE ${WORK}/${FOLDER}/CMakeLists.txt "${text}")
endfunction()

copy_house()
expect()

# An include that the folder does not list.
add_include(scenes/mesh/holes.h scenes/plan/plan.h)
expect("scenes/mesh/CMakeLists.txt does not list scenes/plan")

# It is listed, and now two folders include each other.
permit(scenes/mesh scenes/plan)
expect("there is a cycle of includes among")

# A longer way around: compare/json <- compare/results <- compare/stress.
copy_house()
add_include(compare/json/blocks.h compare/stress/stress_run.h)
permit(compare/json compare/stress)
expect("there is a cycle of includes among")

# Against the arrows of the rooms, though listed.
copy_house()
add_include(reference/parallel.h raster/technique.h)
permit(reference raster)
expect("reference: may never include raster: against the arrows")

# Listed, and not needed.
copy_house()
permit(raster/gl scenes/plan)
expect("raster/gl/CMakeLists.txt: lists scenes/plan, of which nothing is included")

# A head that does not say what the folder is for.
copy_house()
file(READ ${WORK}/raster/gl/CMakeLists.txt text)
string(REGEX REPLACE "^# [^\n]*\n" "" text "${text}")
file(WRITE ${WORK}/raster/gl/CMakeLists.txt "${text}")
expect("raster/gl/CMakeLists.txt: its head does not say what the folder is for")

# A folder without any.
copy_house()
file(REMOVE ${WORK}/raster/gl/CMakeLists.txt)
expect("raster/gl: has no CMakeLists.txt that says what it may include")

# More files than a person finds their way in.
copy_house()
foreach(i RANGE 1 27)
    file(WRITE ${WORK}/raster/gl/more_${i}.h "")
endforeach()
expect("raster/gl: has more than 26 units")

# Two types of one name, as different as they may be.
copy_house()
file(APPEND ${WORK}/raster/gl/gl.h "enum class Scene : std::uint8_t { one };\n")
expect("shadowproof::Scene is also a type of")

file(REMOVE_RECURSE ${WORK})
