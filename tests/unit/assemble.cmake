# SPDX-License-Identifier: MIT
# cmake -DAS=spirv-as -DFRAME=FILE -DTEXTS=FILE;... -DOUT=HEADER -P assemble.cmake
# Writes a header with the words of modules, which are texts of SPIR-V assembly behind a frame that they share. The first
# line of each text, which may be a whole module, is a comment that the header's table gives as what is expected: `; refused: ...` or `; taken`.
get_filename_component(folder ${OUT} DIRECTORY)
file(READ ${FRAME} frame)
set(rows)
set(header "// Written by assemble.cmake.\n")
foreach(text IN LISTS TEXTS)
  get_filename_component(name ${text} NAME_WE)
  file(READ ${text} body)
  string(REGEX MATCH "^; *([^\n]*)" expected "${body}")
  set(expected "${CMAKE_MATCH_1}")
  if(body MATCHES "OpCapability")
    file(WRITE ${folder}/${name}.spvasm "${body}")
  else()
    file(WRITE ${folder}/${name}.spvasm "${frame}${body}")
  endif()
  execute_process(COMMAND ${AS} --target-env spv1.3 -o ${folder}/${name}.spv ${folder}/${name}.spvasm
    RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${text} is not assembled")
  endif()
  file(READ ${folder}/${name}.spv bytes HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
  string(REGEX REPLACE "(...........,...........,...........,...........,...........,...........,...........,...........,)"
    "\\1\n" words "${words}")
  string(APPEND header "static const uint32_t ${name}[] = {\n${words}\n};\n")
  string(APPEND rows "    {\"${name}\", \"${expected}\", ${name}, sizeof ${name}},\n")
endforeach()
file(WRITE ${OUT} "${header}\nstatic const struct assembled assembled[] = {\n${rows}};\n")
