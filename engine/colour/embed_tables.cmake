# cmake -DOUTPUT=<file.cpp> -DDATA=<folder> -P embed_tables.cmake
# Writes the tables of DATA as string literals. A literal per line keeps within every compiler's limit on literals.
set(tables
  kCie1931 cie1931_2deg_xyz_1nm.csv
  kMallett2019 mallett2019_srgb_basis_5nm.csv
  kIlluminantA illuminants/illuminant_A.csv
  kIlluminantD65 illuminants/illuminant_D65.csv
  kIlluminantE illuminants/illuminant_E.csv
  kIlluminantF2 illuminants/illuminant_F2.csv
  kIlluminantF11 illuminants/illuminant_F11.csv
  kIlluminantLedB3 illuminants/illuminant_LED-B3.csv
  kMetalAl metals/Al_nk.csv
  kMetalAg metals/Ag_nk.csv
  kMetalAu metals/Au_nk.csv
  kMetalCu metals/Cu_nk.csv)

set(code "// Written by embed_tables.cmake.\n#include \"engine/colour/embedded_tables.h\"\n\nnamespace rowland::colour::embedded {\n")
while(tables)
  list(POP_FRONT tables name file)
  file(READ ${DATA}/${file} text)
  string(REGEX REPLACE "([^\n]+)\r?\n?" "    \"\\1\\\\n\"\n" text "${text}")
  string(APPEND code "\nconst std::string_view ${name} =\n${text}    ;\n")
endwhile()
string(APPEND code "\n}  // namespace rowland::colour::embedded\n")
file(WRITE ${OUTPUT} "${code}")
