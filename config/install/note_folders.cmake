# Begins `cmake --install`: notes which folders, of those that others use as well, are not there yet. `uninstall`
# takes them away again, and leaves the empty ones that were there before. Folders called priamos are ours anyway.
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_PREFIX NORMALIZE)  # the unit names it
set(made)
if(EXISTS "${folders_file}")
  file(STRINGS "${folders_file}" made)
endif()
foreach(folder "" /bin /etc /lib /lib/systemd /lib/systemd/system /lib/sysusers.d /share /share/bash-completion
        /share/bash-completion/completions /share/doc /share/fish /share/fish/vendor_completions.d /share/man
        /share/man/man1 /share/man/man5 /share/zsh /share/zsh/site-functions)
  if(NOT EXISTS "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}${folder}")
    list(APPEND made "${CMAKE_INSTALL_PREFIX}${folder}")
  endif()
endforeach()
list(REMOVE_DUPLICATES made)
string(REPLACE ";" "\n" text "${made}")
file(WRITE "${folders_file}" "${text}\n")
