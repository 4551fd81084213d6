# cmake -DOUTPUT=<file.cpp> -DFRAMES=<folder> -P embed_frames.cmake
# Writes the named frame sets as string literals, a literal per line.
set(code "// Written by embed_frames.cmake.\n#include \"modules/diffraction/evaluate/embedded_frames.h\"\n\nnamespace rowland::diffraction::embedded {\n")
foreach(set kTiltedDisc:tilted_disc kSphere:sphere)
  string(REPLACE ":" ";" set ${set})
  list(POP_FRONT set name file)
  file(READ ${FRAMES}/${file}.csv text)
  string(REGEX REPLACE "([^\n]+)\r?\n?" "    \"\\1\\\\n\"\n" text "${text}")
  string(APPEND code "\nconst std::string_view ${name} =\n${text}    ;\n")
endforeach()
string(APPEND code "\n}  // namespace rowland::diffraction::embedded\n")
file(WRITE ${OUTPUT} "${code}")
