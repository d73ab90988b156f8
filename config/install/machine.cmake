# Run by `cmake --install`: what belongs to one machine. The configuration of a robot, where a file that is there
# stays as it is, and the unit, which names the programs where they really are.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(etc /etc/priamos)  # as SystemConfigFolder in modules/common/data_folders
else()
  set(etc "${CMAKE_INSTALL_PREFIX}/etc/priamos")
endif()

file(GLOB_RECURSE files RELATIVE "${config_source}/robot" "${config_source}/robot/[a-z]*.toml")
foreach(file ${files})
  if(EXISTS "$ENV{DESTDIR}${etc}/robot/${file}")
    message(STATUS "Kept: $ENV{DESTDIR}${etc}/robot/${file}")
    list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${etc}/robot/${file}")
  else()
    get_filename_component(folder "${etc}/robot/${file}" DIRECTORY)
    make_folder("${root}${folder}")
    file(INSTALL "${config_source}/robot/${file}" DESTINATION "${folder}" FILE_PERMISSIONS ${readable})
  endif()
endforeach()

# systemd reads quotes and backslashes in a command, $ behind its program, and % everywhere.
string(REPLACE "%" "%%" etc_of_unit "${etc}")
string(REPLACE "%" "%%" bin_of_unit "${CMAKE_INSTALL_PREFIX}/bin")
foreach(name etc bin)
  string(REPLACE "\\" "\\\\" ${name}_quoted "${${name}_of_unit}")
  string(REPLACE "\"" "\\\"" ${name}_quoted "${${name}_quoted}")
endforeach()
string(REPLACE "$" "$$" etc_quoted "${etc_quoted}")
set(unit "${CMAKE_INSTALL_PREFIX}/lib/systemd/system/priamos@.service")
configure_file("${config_source}/robot/systemd/priamos@.service.in" "$ENV{DESTDIR}${unit}" @ONLY
               FILE_PERMISSIONS ${readable})
message(STATUS "Installing: $ENV{DESTDIR}${unit}")
list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${unit}")
