# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DBUILD_DIR=… -DSOURCE_DIR=… -DWORK_DIR=… -P run.cmake: installs the build, then builds and runs the user's
# project against the installation.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")
run(${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix with blank")
run(${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${WORK_DIR}/build" -G Ninja -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix with blank")
run(${CMAKE_COMMAND} --build "${WORK_DIR}/build")

# 25 holes of five intervals, and a fault through their middle as a table of points.
set(collars "hole,x,y,z\n")
set(log "hole,from,to,grade\n")
foreach(i RANGE 0 24)
  math(EXPR x "525500 + 10 * (${i} % 5)")
  math(EXPR y "6792000 + 10 * (${i} / 5)")
  string(APPEND collars "B${i},${x},${y},0\n")
  foreach(k RANGE 0 4)
    math(EXPR from "10 * ${k}")
    math(EXPR to "10 * ${k} + 10")
    math(EXPR grade "${i} + 3 * ${k}")
    string(APPEND log "B${i},${from},${to},${grade}\n")
  endforeach()
endforeach()
set(fault "x,y,z,fault\n")
foreach(i RANGE 0 10)
  foreach(k RANGE 0 10)
    math(EXPR y "6791970 + 10 * ${i}")
    math(EXPR z "20 - 10 * ${k}")
    string(APPEND fault "525524.5,${y},${z},F\n")
  endforeach()
endforeach()
file(WRITE "${WORK_DIR}/collar.csv" "${collars}")
file(WRITE "${WORK_DIR}/log.csv" "${log}")
file(WRITE "${WORK_DIR}/fault.csv" "${fault}")

set(terratet "${WORK_DIR}/prefix with blank/bin/terratet")
set(inputs --boreholes "${WORK_DIR}/collar.csv" --log "${WORK_DIR}/log.csv" -s_srs EPSG:3067 -q)
function(expect_same a b)
  file(SHA256 "${a}" first)
  file(SHA256 "${b}" second)
  if(NOT first STREQUAL second)
    message(FATAL_ERROR "${a} and ${b} differ")
  endif()
endfunction()

run("${WORK_DIR}/build/first_model" "${WORK_DIR}/collar.csv" "${WORK_DIR}/log.csv" "${WORK_DIR}/first.vtu")
if(NOT output MATCHES "^[0-9.]+\n[1-9][0-9]*\n$")
  message(FATAL_ERROR "first_model printed ${output}")
endif()
run("${terratet}" convert ${inputs} "${WORK_DIR}/same.vtu")
expect_same("${WORK_DIR}/first.vtu" "${WORK_DIR}/same.vtu")

# Without the fault, as `terratet edit` leaves it.
run("${terratet}" convert ${inputs} --faults "${WORK_DIR}/fault.csv" "${WORK_DIR}/faulted.gpkg" "${WORK_DIR}/faulted.vtu")
run("${WORK_DIR}/build/without_fault" "${WORK_DIR}/faulted.gpkg" F "${WORK_DIR}/healed.vtu")
run("${terratet}" edit -q "${WORK_DIR}/faulted.gpkg" remove-fault F)
run("${terratet}" export -q "${WORK_DIR}/faulted.gpkg" "${WORK_DIR}/edited.vtu")
expect_same("${WORK_DIR}/edited.vtu" "${WORK_DIR}/healed.vtu")
