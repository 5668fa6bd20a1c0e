# SPDX-License-Identifier: MIT
# A folder of tests/unit is a room and one program, unit_ROOM; each of its files is one ctest entry of the same name.
# tests/windows calls these functions, too.

set(RHW_UNIT_TESTS "" CACHE STRING "The unit tests to build, such as test_query;test_waves; empty: all of them")
set(RHW_UNIT_FOLDER ${CMAKE_CURRENT_LIST_DIR})

# Adds the program of a room, if it has a file beside those whose names follow.
function(rhw_unit_room room)
  file(GLOB sources CONFIGURE_DEPENDS ${RHW_UNIT_FOLDER}/${room}/test_*.c)
  set(files)
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    if(NOT name IN_LIST ARGN AND (NOT RHW_UNIT_TESTS OR name IN_LIST RHW_UNIT_TESTS))
      list(APPEND files ${source})
      string(APPEND declarations "extern const struct unit_tests ${name};\n")
      string(APPEND rows "    {\"${name}\", &${name}},\n")
      add_test(NAME ${name} COMMAND unit_${room} --filter ${name})
      set_tests_properties(${name} PROPERTIES TIMEOUT ${RHW_TEST_TIMEOUT} LABELS unit)
    endif()
  endforeach()
  if(NOT files)
    return()
  endif()
  file(GLOB rigs CONFIGURE_DEPENDS ${RHW_UNIT_FOLDER}/${room}/*_rig.c) # what files of the room share
  set(table ${CMAKE_CURRENT_BINARY_DIR}/unit_${room}.c)
  file(GENERATE OUTPUT ${table} CONTENT
    "#include \"unit.h\"\n\n${declarations}\nconst struct unit_file unit_files[] = {\n${rows}    {0},\n};\n")
  add_executable(unit_${room} ${RHW_UNIT_FOLDER}/harness/unit.c ${table} ${files} ${rigs})
  # For quoted includes alone, so that a name of ours never hides one of the system's.
  target_compile_options(unit_${room} PRIVATE ${RHW_TEST_OPTIONS} "SHELL:-iquote ${PROJECT_SOURCE_DIR}/src"
    "SHELL:-iquote ${PROJECT_SOURCE_DIR}/scene")
  target_link_libraries(unit_${room} PRIVATE rhw_harness rhw_options Threads::Threads)
  add_dependencies(unit unit_${room})
  file(GLOB texts CONFIGURE_DEPENDS ${RHW_UNIT_FOLDER}/${room}/glsl/*)
  if(texts)
    rhw_add_glsl(unit_${room} ${texts})
    rhw_add_optimized(unit_${room} ${texts})
    if(NOT CMAKE_CROSSCOMPILING)
      rhw_add_emitted(unit_${room} ${texts})
      foreach(source ${files}) # those that draw or dispatch
        get_filename_component(name ${source} NAME_WE)
        file(READ ${source} text)
        if(text MATCHES "rhw_shader_program_get|spirv_dispatch|spirv_run")
          add_test(NAME ${name}_in_c COMMAND unit_${room} --filter ${name})
          set_tests_properties(${name}_in_c PROPERTIES TIMEOUT ${RHW_TEST_TIMEOUT} LABELS unit
            ENVIRONMENT RHW_TEST_BACK_END=c)
          add_test(NAME ${name}_interpreted COMMAND unit_${room} --filter ${name})
          set_tests_properties(${name}_interpreted PROPERTIES TIMEOUT ${RHW_TEST_TIMEOUT} LABELS unit ENVIRONMENT RHW_JIT=0)
        endif()
      endforeach()
    endif()
  endif()
  file(GLOB texts CONFIGURE_DEPENDS ${RHW_UNIT_FOLDER}/${room}/asm/*.spvasm)
  if(texts)
    rhw_add_assembly(unit_${room} ${RHW_UNIT_FOLDER}/${room}/asm/frame.inc ${texts})
  endif()
endfunction()

# Gives a target a header NAME_comp_small.h of each compute shader among GLSL texts: its words as an optimizer leaves them,
# `const uint32_t NAME_comp_small[]`.
function(rhw_add_optimized target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_glsl)
  list(FILTER ARGN INCLUDE REGEX "\\.comp$")
  foreach(text ${ARGN})
    get_filename_component(name ${text} NAME_WE)
    set(header ${folder}/${name}_comp_small.h)
    add_custom_command(OUTPUT ${header} DEPENDS ${text} VERBATIM
      COMMAND ${RHW_GLSLANG} -V -Os --quiet --target-env vulkan1.1 --vn ${name}_comp_small -o ${header} ${text})
    target_sources(${target} PRIVATE ${header})
  endforeach()
endfunction()

# Gives a target what the emitter writes of GLSL texts, so that its tests can draw with C (harness/emitted.h). A fragment
# shader goes with the vertex shader of its name or of the part before "_", or with plain.vert.
function(rhw_add_emitted target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_c)
  file(MAKE_DIRECTORY ${folder})
  if(NOT TARGET emit_tool)
    add_executable(emit_tool ${RHW_UNIT_FOLDER}/harness/emit_tool.c)
    target_link_libraries(emit_tool PRIVATE rhw_shader rhw_options)
  endif()
  set(written)
  set(rows)
  foreach(text ${ARGN})
    get_filename_component(file ${text} NAME)
    get_filename_component(name ${text} NAME_WE)
    string(REGEX REPLACE "_.*" "" first ${name})
    add_custom_command(OUTPUT ${folder}/${file}.spv DEPENDS ${text} VERBATIM
      COMMAND ${RHW_GLSLANG} -V --quiet --target-env vulkan1.1 -o ${folder}/${file}.spv ${text})
    set(modules)
    if(file MATCHES "\\.comp$")
      set(name ${name}_comp) # a fragment shader may have the same name
      set(modules ${folder}/${file}.spv)
    elseif(file MATCHES "\\.frag$" AND EXISTS ${RHW_UNIT_FOLDER}/spirv/glsl/${first}.vert)
      set(modules ${folder}/${first}.vert.spv ${folder}/${file}.spv)
    elseif(file MATCHES "\\.frag$")
      set(modules ${folder}/plain.vert.spv ${folder}/${file}.spv)
    endif()
    if(modules)
      add_custom_command(OUTPUT ${folder}/${name}.c ${folder}/${name}.inc DEPENDS emit_tool ${modules} VERBATIM
        COMMAND emit_tool in_c_${name} ${folder}/${name} ${modules})
      list(APPEND written ${folder}/${name}.c)
      list(APPEND rows ${folder}/${name}.inc)
      string(APPEND includes "#include \"${name}.inc\"\n")
    endif()
  endforeach()
  file(GENERATE OUTPUT ${folder}/emitted_rows.inc CONTENT "${includes}")
  target_sources(${target} PRIVATE ${RHW_UNIT_FOLDER}/harness/emitted.c ${rows})
  set_source_files_properties(${RHW_UNIT_FOLDER}/harness/emitted.c PROPERTIES OBJECT_DEPENDS "${rows}")
  target_include_directories(${target} PRIVATE ${folder})
  target_compile_definitions(${target} PRIVATE rhw_shader_create=emitted_shader_create
    rhw_shader_program_create=emitted_program_create rhw_shader_program_get=emitted_program_get
    rhw_shader_program_get_compute=emitted_program_get_compute)
  rhw_add_shaders(${target} ${written})
endfunction()

# Gives a target a header assembled.h of texts of SPIR-V assembly behind a frame (assemble.cmake).
function(rhw_add_assembly target frame)
  find_program(RHW_SPIRV_AS spirv-as REQUIRED)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_asm)
  file(MAKE_DIRECTORY ${folder})
  set(script ${RHW_UNIT_FOLDER}/assemble.cmake)
  add_custom_command(OUTPUT ${folder}/assembled.h DEPENDS ${frame} ${ARGN} ${script} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DAS=${RHW_SPIRV_AS} -DFRAME=${frame} "-DTEXTS=${ARGN}" -DOUT=${folder}/assembled.h
      -P ${script})
  target_sources(${target} PRIVATE ${folder}/assembled.h)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()

# Adds the programs of all rooms, and the target `unit` that builds them. Leaves out rooms and files whose names follow.
function(rhw_unit_rooms)
  add_custom_target(unit)
  file(GLOB rooms CONFIGURE_DEPENDS RELATIVE ${RHW_UNIT_FOLDER} ${RHW_UNIT_FOLDER}/*)
  foreach(room ${rooms})
    if(NOT room IN_LIST ARGN)
      rhw_unit_room(${room} ${ARGN})
    endif()
  endforeach()
  foreach(name ${RHW_UNIT_TESTS})
    if(NOT TEST ${name})
      message(FATAL_ERROR "RHW_UNIT_TESTS has ${name}, of which there is no file in tests/unit")
    endif()
  endforeach()
endfunction()
