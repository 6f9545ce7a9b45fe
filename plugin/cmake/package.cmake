# Debian packages, made by `cpack --preset package`: libseam0 with the libraries, libseam-dev with what it takes to build
# on them, seam with the program, python3-seam with the module of Python.

set(CPACK_PACKAGE_NAME seam)
set(CPACK_PACKAGE_CONTACT "seam authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
if(SEAM_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libseam${PROJECT_VERSION_MAJOR})
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Movement primitives on a Bullet arm: shared libraries, for Bullet in double and in float.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_CURRENT_BINARY_DIR})

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libseam-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Movement primitives on a Bullet arm: headers, CMake and pkg-config files.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libseam${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION}), \
libeigen3-dev (>= 3.4), libbullet-dev, libbullet-extras-dev")
if(NOT BUILD_SHARED_LIBS)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL runtime)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libbullet-dev, libbullet-extras-dev, \
liburdfdom-dev, libconsole-bridge-dev, libassimp-dev, libtinyxml2-dev, libyaml-cpp-dev")
endif()

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME seam)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Movement primitives on a Bullet arm: the program, its scenes and the arm that they play.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What it loads or starts, which no linker sees.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
  "gnuplot-nox | gnuplot, fonts-dejavu-core, libegl1, libegl-mesa0, libgl1-mesa-dri, libopengl0")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ffmpeg)

# The module fits one minor version of Python. What it plays is the program's. (CPack remarks that it has no soname: nobody
# links it.)
if(SEAM_PYTHON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-seam)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Movement primitives on a Bullet arm: the module of Python.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  if(SEAM_PROGRAM)
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", seam (= ${PROJECT_VERSION})")
  endif()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-matplotlib)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-pandas)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${CMAKE_CURRENT_LIST_DIR}/python3-seam/postinst ${CMAKE_CURRENT_LIST_DIR}/python3-seam/prerm)
endif()
include(CPack)
