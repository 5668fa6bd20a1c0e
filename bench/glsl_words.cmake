# SPDX-License-Identifier: MIT
# Compiles the texts that glsl_texts wrote, and writes OUT: for each, its words, and the macro SHADERS(X), which has an
# X(shader, words of its vertex stage, words of its fragment stage) for each.
#   cmake -DGLSLANG=PROGRAM -DFOLDER=FOLDER -DOUT=FILE -P glsl_words.cmake
file(GLOB texts RELATIVE ${FOLDER} ${FOLDER}/*.vert)
list(SORT texts COMPARE NATURAL)
set(words "")
set(rows "#define SHADERS(X)")
foreach(text IN LISTS texts)
  get_filename_component(number ${text} NAME_WE)
  foreach(stage vert frag)
    execute_process(COMMAND ${GLSLANG} -V --quiet --vn ${stage}_${number} -o ${FOLDER}/${number}_${stage}.h ${FOLDER}/${number}.${stage}
      RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(failed)
      message(FATAL_ERROR "${number}.${stage} does not compile:\n${said}")
    endif()
    file(READ ${FOLDER}/${number}_${stage}.h header)
    string(REGEX REPLACE "[^\n]*#pragma once" "" header "${header}")
    string(APPEND words "static ${header}\n")
  endforeach()
  string(APPEND rows " \\\n    X(${number}, vert_${number}, frag_${number})")
endforeach()
file(WRITE ${OUT} "${words}\n${rows}\n")
