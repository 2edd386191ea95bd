# cmake -D files=A;B -D output=FILE -P embed.cmake: see quoll_embed.
set(text "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} content)
  string(APPEND text "{\"${name}\", R\"quoll(${content})quoll\"},\n")
endforeach()
file(WRITE ${output} "${text}")
