# SPDX-License-Identifier: MIT
# How sources written on 8 lanes are compiled once per instruction set. find_package(rhw) brings it for a program's
# shaders, and the library's own build includes it for its kernels.
cmake_policy(VERSION 3.22)

# The instruction sets, the same ones as in rhw/isa.h. They stand in the cache because a function is seen in every
# folder, and a folder's variables are not.
set(isas baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
  list(APPEND isas avx2 avx512)
endif()
set(avx2 -mavx2 -mf16c -mbmi -mbmi2 -mlzcnt -mpopcnt)
if(WIN32 AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
  # gcc for Windows aligns the stack to 16 bytes and stores registers of 32 there with instructions that want 32 (gcc bug
  # 54412). The assembler, from binutils 2.38 on, makes them those that want none.
  list(APPEND avx2 -Wa,-muse-unaligned-vector-move)
endif()
set(avx512 ${avx2} -mavx512f -mavx512bw -mavx512dq -mavx512vl -mprefer-vector-width=256)
set(RHW_ISAS ${isas} CACHE INTERNAL "Instruction sets that sources on 8 lanes are compiled for")
foreach(isa IN LISTS RHW_ISAS)
  set(RHW_ISA_FLAGS_${isa} ${${isa}} CACHE INTERNAL "What the compiler is given for ${isa}")
endforeach()

# Of these, -ffp-contract=off is the promise of equal bytes.
set(shader_flags -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
  # gcc 12 drops the rounding of (double)(float)x when it packs two such statements into one vector; loops and
  # explicit vectors are right.
  list(APPEND shader_flags -fno-tree-slp-vectorize)
endif()
set(RHW_SHADER_FLAGS ${shader_flags} CACHE INTERNAL "What the compiler is given for every instruction set")
foreach(name isas isa avx2 avx512 shader_flags)
  unset(${name})
endforeach()

# Sets RESULT to the files with C in the place of shaders in GLSL and SPIR-V.
function(rhw_write_shaders target result)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_c)
  set(names)
  set(files)
  foreach(file IN LISTS ARGN)
    if(file MATCHES "\\.(vert|frag|comp)(\\.spv)?$")
      get_filename_component(path ${file} ABSOLUTE)
      get_filename_component(name ${file} NAME)
      string(REGEX REPLACE "\\.(vert|frag|comp)(\\.spv)?$" "" name ${name})
      string(MAKE_C_IDENTIFIER ${name} name)
      if(NOT name IN_LIST names)
        list(APPEND names ${name})
        list(APPEND files ${folder}/${name}.c)
        set(shaders_${name})
      endif()
      list(APPEND shaders_${name} ${path})
    else()
      list(APPEND files ${file})
    endif()
  endforeach()
  set(${result} "${files}" PARENT_SCOPE)
  if(NOT names)
    return()
  endif()
  if(TARGET rhw_program)
    set(program rhw_program)
  else()
    set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
    find_program(RHW_PROGRAM_FILE rhw HINTS ${here}/../../../bin ${here}/../../../../bin) # where the package stands
    set(program ${RHW_PROGRAM_FILE})
    if(NOT program)
      message(FATAL_ERROR "rhw_add_shaders: ${target} has shaders in GLSL or SPIR-V, and there is no program rhw "
        "that would write them as C; install it, or set RHW_PROGRAM_FILE")
    endif()
  endif()
  file(MAKE_DIRECTORY ${folder})
  foreach(name IN LISTS names)
    add_custom_command(OUTPUT ${folder}/${name}.c DEPENDS ${program} ${shaders_${name}} VERBATIM
      DEPFILE ${folder}/${name}.c.d
      COMMAND ${program} shader ${shaders_${name}} -o ${folder}/${name}.c --depfile ${folder}/${name}.c.d)
  endforeach()
endfunction()

# rhw_add_shaders(TARGET FILE...): compiles each FILE once per instruction set, with RHW_ISA_SUFFIX=baseline, avx2, ...
# so that RHW_ISA_NAME(name) of rhw/isa.h gives each copy its own name, and adds the copies to TARGET. They see the
# include folders, definitions, options and libraries of TARGET, also those that it is given later.
# A FILE may be a shader in GLSL, NAME.comp or NAME.vert and NAME.frag, or in SPIR-V, NAME.comp.spv and so on: the program
# rhw writes it as C first, and TARGET has NAME_program (rhw/spirv.h, rhw_shader_program_emit_c). What an identifier of C
# has not is a _ in NAME. The C is made anew when a FILE changes, or a file that it includes.
function(rhw_add_shaders target)
  if(NOT TARGET ${target})
    message(FATAL_ERROR "rhw_add_shaders: there is no target ${target}; add_executable or add_library makes it first")
  endif()
  get_target_property(imported ${target} IMPORTED)
  if(imported)
    message(FATAL_ERROR "rhw_add_shaders: ${target} is imported; shaders belong to a target of this project")
  endif()
  if(NOT ARGN)
    message(FATAL_ERROR "rhw_add_shaders: ${target} is given no file")
  endif()
  rhw_write_shaders(${target} files ${ARGN})
  if(NOT CMAKE_C_COMPILE_OBJECT AND "${files}" MATCHES "\\.c(;|$)")
    message(FATAL_ERROR "rhw_add_shaders: ${target} has shaders in C, a language that this project does not enable; "
      "name it in project(), or call enable_language(C)")
  endif()
  foreach(isa IN LISTS RHW_ISAS)
    set(copy ${target}_${isa})
    if(TARGET ${copy})
      target_sources(${copy} PRIVATE ${files})
      continue()
    endif()
    add_library(${copy} OBJECT ${files})
    if(NOT EMSCRIPTEN) # WebAssembly modules are linked once, and smaller without
      set_target_properties(${copy} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
    foreach(property C_STANDARD C_STANDARD_REQUIRED C_EXTENSIONS C_VISIBILITY_PRESET
        CXX_STANDARD CXX_STANDARD_REQUIRED CXX_EXTENSIONS CXX_VISIBILITY_PRESET)
      get_target_property(value ${target} ${property})
      if(NOT value MATCHES "NOTFOUND$")
        set_target_properties(${copy} PROPERTIES ${property} ${value})
      endif()
    endforeach()
    target_include_directories(${copy} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${copy} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS> RHW_ISA_SUFFIX=${isa})
    target_compile_options(${copy} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_OPTIONS>
      ${RHW_SHADER_FLAGS} ${RHW_ISA_FLAGS_${isa}})
    target_link_libraries(${copy} PRIVATE $<TARGET_PROPERTY:${target},LINK_LIBRARIES>)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${copy}>)
  endforeach()
endfunction()
