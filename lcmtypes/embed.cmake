# Writes OUTPUT, a .cpp that holds the text of FILES (see embedded_types.hpp).
set(code "#include \"lcmtypes/embedded_types.hpp\"\n\nnamespace priamos {\n\nstd::vector<TypeText> EmbeddedTypes() {\n  return {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND code "      {\"lcmtypes/${name}\", R\"lcm(${text})lcm\"},\n")
endforeach()
file(WRITE ${OUTPUT} "${code}  };\n}\n\n}  // namespace priamos\n")
