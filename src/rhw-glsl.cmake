# SPDX-License-Identifier: MIT
# How a program has shaders in GLSL inside, as words of SPIR-V. find_package(rhw) brings it, and the lessons are built with
# it. It wants glslangValidator (Debian: glslang-tools) on the machine that compiles, and nothing on the one that runs.
if(CMAKE_SCRIPT_MODE_FILE) # the command that rhw_add_glsl gives to the build
  set(depfile)
  if(DEPFILE)
    set(depfile --depfile ${DEPFILE})
  endif()
  execute_process(COMMAND ${GLSLANG} -V --quiet --target-env vulkan1.1 --vn ${NAME} ${depfile} -o ${HEADER} ${TEXT}
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    file(REMOVE ${HEADER})
    message(FATAL_ERROR "${TEXT} is no shader")
  endif()
  file(READ ${HEADER} words)
  string(REPLACE "const uint32_t" "static const uint32_t" words "${words}") # for several files of a program
  file(WRITE ${HEADER} "#include <stdint.h>\n${words}")
  return()
endif()
cmake_policy(VERSION 3.22)
set(RHW_GLSL_SCRIPT ${CMAKE_CURRENT_LIST_FILE} CACHE INTERNAL "What makes a header of a GLSL text")

# rhw_add_glsl(TARGET FILE...): TARGET may include a header NAME_STAGE.h for each text NAME.STAGE (.vert, .frag, .comp),
# whose words are `static const uint32_t NAME_STAGE[]`, as rhw_shader_create takes them. What an identifier of C has not,
# a - for instance, is a _ there. The header is made anew when the text changes, or a file that it includes.
function(rhw_add_glsl target)
  find_program(RHW_GLSLANG glslangValidator)
  if(NOT RHW_GLSLANG)
    message(FATAL_ERROR "rhw_add_glsl: ${target} has shaders in GLSL, and there is no glslangValidator "
      "(Debian: apt-get install glslang-tools)")
  endif()
  if(NOT DEFINED RHW_GLSLANG_DEPFILE)
    execute_process(COMMAND ${RHW_GLSLANG} --help OUTPUT_VARIABLE help ERROR_QUIET)
    string(FIND "${help}" "--depfile" place)
    set(RHW_GLSLANG_DEPFILE ${place} CACHE INTERNAL "Where glslangValidator tells of --depfile; -1: it has none")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_glsl)
  file(MAKE_DIRECTORY ${folder})
  foreach(text ${ARGN})
    get_filename_component(text ${text} ABSOLUTE)
    get_filename_component(file ${text} NAME)
    string(MAKE_C_IDENTIFIER ${file} name)
    set(header ${folder}/${name}.h)
    set(depfile)
    if(NOT RHW_GLSLANG_DEPFILE EQUAL -1)
      set(depfile DEPFILE ${header}.d)
    endif()
    add_custom_command(OUTPUT ${header} DEPENDS ${text} ${depfile} VERBATIM
      COMMAND ${CMAKE_COMMAND} -DGLSLANG=${RHW_GLSLANG} -DTEXT=${text} -DNAME=${name} -DHEADER=${header}
        "-DDEPFILE=$<$<BOOL:${depfile}>:${header}.d>" -P ${RHW_GLSL_SCRIPT})
    target_sources(${target} PRIVATE ${header})
  endforeach()
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
