# The module as it is installed. Beside the program it plays the scenes in the program's share/seam. Alone, as in a wheel,
# it brings them along. seam/__init__.py finds either from where it lies itself.
include(GNUInstallDirs)
set(SEAM_PYTHON_DIR lib/python3/dist-packages CACHE STRING
  "Where the module is installed, from CMAKE_INSTALL_PREFIX; as it stands, where Debian's own Python looks")
cmake_path(SET module NORMALIZE "${SEAM_PYTHON_DIR}/seam")
install(TARGETS seam_python LIBRARY DESTINATION ${module} COMPONENT python)
install(FILES ${copies} DESTINATION ${module} COMPONENT python)
if(SEAM_PROGRAM)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-seam
    RENAME copyright COMPONENT python)
else()
  seam_install_scenes(${module}/share python)
endif()
