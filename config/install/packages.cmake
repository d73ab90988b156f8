# Debian packages, made by scripts/deb: the tools for any LCM bus, what runs on a robot, what runs at its workstation (and
# simulates a robot there), the bus for programs of others, and for scripts in Python.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME priamos)
set(CPACK_PACKAGE_CONTACT "PRIAMOS <priamos@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tools robot station priamos_bus python)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(same "priamos-tools (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME priamos-tools)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "tools for any LCM bus and log
 priamos topic, log, type, doctor and link: what is on a bus, of any type, without
 compiling it; recording, playing, mending and converting logs; a radio link of 960
 bytes per second.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/config/install/postrm)
set(CPACK_DEBIAN_ROBOT_PACKAGE_NAME priamos-robot)
set(CPACK_COMPONENT_ROBOT_DESCRIPTION "processes on board of a PRIAMOS robot
 The mobile base and the stereo head, with their configuration and systemd units.")
set(CPACK_DEBIAN_ROBOT_PACKAGE_DEPENDS "${same}")
set(CPACK_DEBIAN_STATION_PACKAGE_NAME priamos-station)
set(CPACK_COMPONENT_STATION_DESCRIPTION "workstation of a PRIAMOS robot, and a simulated one
 Planner, station in a browser, driving by hand; and the simulated hardware.")
set(CPACK_DEBIAN_STATION_PACKAGE_DEPENDS "${same}")
set(CPACK_DEBIAN_STATION_PACKAGE_RECOMMENDS priamos-robot)
set(CPACK_DEBIAN_PRIAMOS_BUS_PACKAGE_NAME libpriamos-bus-dev)
set(CPACK_COMPONENT_PRIAMOS_BUS_DESCRIPTION "LCM made safe, visible and replayable (development files)
 Libraries and headers for find_package(priamos_bus).")
set(CPACK_DEBIAN_PRIAMOS_BUS_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PRIAMOS_BUS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PRIAMOS_BUS_PACKAGE_DEPENDS "pkg-config, liblcm-dev, libsodium-dev, libtomlplusplus-dev, \
libeigen3-dev, libfmt-dev, libspdlog-dev, nlohmann-json3-dev, libcli11-dev")

# Alone, and for every machine: logs are looked at where nothing else of PRIAMOS is.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-priamos)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "logs, packed messages and buses of LCM in Python
 Reads any LCM log, also damaged ones and those of old types; packed messages of a
 PRIAMOS radio link, one end of it, and LCM over UDP multicast. Needs Python alone.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.10)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-cryptography)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/config/install/python/postinst;${PROJECT_SOURCE_DIR}/config/install/python/prerm")

# What a person changes in /etc stays at an upgrade; `apt purge` takes it away.
if(PRIAMOS_ROBOT)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/config/robot ${PROJECT_SOURCE_DIR}/config/robot/[a-z]*.toml)
  list(TRANSFORM files PREPEND /etc/priamos/robot/)
  list(JOIN files "\n" conffiles)
  file(WRITE ${PROJECT_BINARY_DIR}/debian/conffiles "${conffiles}\n")
  set(CPACK_DEBIAN_ROBOT_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/conffiles)
else()
  set(CPACK_COMPONENTS_ALL priamos_bus python)
endif()
include(CPack)
