set(PRIAMOS_BUS_EMBED ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)

# priamos_lcm_types(NAME FILE...): a library of the message types in .lcm files. It has the headers that lcm-gen makes of
# them, PACKAGE/TYPE.hpp, and <NAME_types.hpp> with NAME::Types(), their texts, for the schema of a process.
function(priamos_lcm_types name)
  find_program(LCM_GEN lcm-gen REQUIRED)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name}_types)
  set(files)
  foreach(file ${ARGN})
    cmake_path(ABSOLUTE_PATH file)
    list(APPEND files ${file})
  endforeach()
  file(WRITE ${folder}/${name}_types.hpp
    "#pragma once\n\n#include \"lcmtypes/embedded_types.hpp\"\n\nnamespace ${name} {\n\n/// The texts of its .lcm files.\nstd::vector<priamos::TypeText> Types();\n\n}  // namespace ${name}\n")
  set(texts ${folder}/texts.cpp)
  add_custom_command(OUTPUT ${texts}
    COMMAND ${LCM_GEN} -x --cpp-std c++11 --cpp-hpath ${folder} ${files}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${texts} "-DFILES=${files}" -DFUNCTION=${name}::Types -DHEADER=${name}_types.hpp
            -P ${PRIAMOS_BUS_EMBED}
    DEPENDS ${files} VERBATIM COMMENT "lcm-gen: ${name}")
  add_library(${name} STATIC ${texts})
  target_include_directories(${name} SYSTEM PUBLIC ${folder})
  target_link_libraries(${name} PUBLIC priamos::lcmtypes)
endfunction()
