# Completes the help pages that ParaView generates from the XML: each gets its pictures and more text
# before the table of its properties, and the reference to the paper after it. Needs `source`, the
# directory of this file, and `pages`, that of the generated pages, which are kept beside the completed
# ones: what is completed once is completed anew from them.
file(READ "${source}/Reference.html" reference)
file(GLOB additions RELATIVE "${source}" "${source}/*.*.html")
foreach (name IN LISTS additions)
  file(READ "${source}/${name}" addition)
  file(READ "${pages}/${name}" page)
  string(FIND "${page}" "<!-- completed -->" completed)
  if (completed EQUAL -1)
    file(WRITE "${pages}/${name}.generated" "${page}")
  else ()
    file(READ "${pages}/${name}.generated" page)
  endif ()
  string(FIND "${page}" "<table" table)
  string(FIND "${page}" "</body>" end)
  if (table EQUAL -1 OR end EQUAL -1)
    message(FATAL_ERROR "${pages}/${name} has no table of properties")
  endif ()
  math(EXPR length "${end} - ${table}")
  string(SUBSTRING "${page}" 0 ${table} head)
  string(SUBSTRING "${page}" ${table} ${length} properties)
  file(WRITE "${pages}/${name}"
    "${head}<!-- completed -->${addition}<h3>Properties</h3>\n${properties}${reference}</body>\n</html>\n")
endforeach ()
file(COPY "${source}/index.html" DESTINATION "${pages}")
