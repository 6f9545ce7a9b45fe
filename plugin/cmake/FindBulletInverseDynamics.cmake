# FindBulletInverseDynamics: Bullet with its inverse dynamics, in both precisions.
#
# Imported targets; those named …-float64 compute in double, the others in float, and one program takes one kind:
#   Bullet::LinearMath  Bullet::Collision  Bullet::Dynamics          (and each with -float64)
#   Bullet::InverseDynamics         btInverseDynamics::MultiBodyTree  <BulletInverseDynamics/MultiBodyTree.hpp>
#   Bullet::InverseDynamicsUtils    btMultiBodyTreeCreator            <InverseDynamics/btMultiBodyTreeCreator.hpp>
# Each carries its include folders, the libraries that it needs, and BT_USE_DOUBLE_PRECISION where it computes in double.
#
# Debian packages the inverse-dynamics libraries without their headers. These are taken, in this order,
#   from BulletInverseDynamics_INCLUDE_DIR, where it is set;
#   from BULLET_SOURCE_DIR (cache or environment), the top folder of the source of the installed Bullet version;
#   from the installed Bullet, where it has them;
#   from Debian's source package of the installed version, downloaded once by bullet-headers.sh beside this file into
#   BULLET_HEADERS_DIR (default: bullet-headers in the top build folder).
# A project that only links, as the user of a static library does, sets BulletInverseDynamics_LINK_ONLY: no headers then.
#
# Result: BulletInverseDynamics_FOUND, BulletInverseDynamics_VERSION, BulletInverseDynamics_INCLUDE_DIRS, and
# BulletInverseDynamics_float64_FOUND, BulletInverseDynamics_float32_FOUND: whether each precision is installed.

set(BULLET_SOURCE_DIR "" CACHE PATH "Top folder of Bullet's source, for headers that are not installed")
set(BULLET_HEADERS_DIR "${CMAKE_BINARY_DIR}/bullet-headers" CACHE PATH "Where headers that are not installed are kept")
set(_bullet_headers "${BULLET_HEADERS_DIR}")
set(_bullet_source "${BULLET_SOURCE_DIR}")
if(NOT _bullet_source)
  set(_bullet_source "$ENV{BULLET_SOURCE_DIR}")
endif()

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_Bullet_float64 QUIET bullet-float64)
  pkg_check_modules(PC_Bullet_float32 QUIET bullet)
endif()
set(BulletInverseDynamics_VERSION "${PC_Bullet_float64_VERSION}")
if(NOT BulletInverseDynamics_VERSION)
  set(BulletInverseDynamics_VERSION "${PC_Bullet_float32_VERSION}")
endif()

find_path(Bullet_INCLUDE_DIR btBulletDynamicsCommon.h
  HINTS ${PC_Bullet_float64_INCLUDE_DIRS} ${PC_Bullet_float32_INCLUDE_DIRS} PATH_SUFFIXES bullet)
mark_as_advanced(Bullet_INCLUDE_DIR)
set(_bullet_reason "")

if(BulletInverseDynamics_LINK_ONLY)
  set(BulletInverseDynamics_INCLUDE_DIRS ${Bullet_INCLUDE_DIR})
elseif(BulletInverseDynamics_INCLUDE_DIR)
  set(BulletInverseDynamics_INCLUDE_DIRS ${BulletInverseDynamics_INCLUDE_DIR} ${Bullet_INCLUDE_DIR})
elseif(Bullet_INCLUDE_DIR AND NOT _bullet_source
       AND EXISTS "${Bullet_INCLUDE_DIR}/BulletInverseDynamics/MultiBodyTree.hpp")
  set(BulletInverseDynamics_INCLUDE_DIRS ${Bullet_INCLUDE_DIR})
elseif(Bullet_INCLUDE_DIR)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env "BULLET_SOURCE_DIR=${_bullet_source}"
            sh "${CMAKE_CURRENT_LIST_DIR}/bullet-headers.sh" "${_bullet_headers}"
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}"
    RESULT_VARIABLE _bullet_result ERROR_VARIABLE _bullet_reason ERROR_STRIP_TRAILING_WHITESPACE)
  string(REPLACE ";" "," _bullet_reason "${_bullet_reason}")
  if(_bullet_result EQUAL 0)
    set(BulletInverseDynamics_INCLUDE_DIRS ${_bullet_headers} ${Bullet_INCLUDE_DIR})
    file(GLOB _bullet_installed "/var/lib/dpkg/info/libbullet-dev*.list")  # changes with every upgrade of Bullet
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
      "${_bullet_headers}/BulletInverseDynamics/MultiBodyTree.hpp" ${_bullet_installed})
  endif()
endif()

# Adds Bullet::<name><suffix>, which needs the targets named after it.
function(_bullet_target precision suffix name)
  string(REGEX REPLACE "^Bullet([A-Z])" "\\1" short ${name})
  set(target Bullet::${short}${suffix})
  find_library(Bullet_${name}_${precision}_LIBRARY ${name}${suffix} HINTS ${PC_Bullet_${precision}_LIBRARY_DIRS})
  mark_as_advanced(Bullet_${name}_${precision}_LIBRARY)
  if(NOT Bullet_${name}_${precision}_LIBRARY OR NOT BulletInverseDynamics_INCLUDE_DIRS)
    set(BulletInverseDynamics_${precision}_FOUND FALSE PARENT_SCOPE)
  elseif(NOT TARGET ${target})
    add_library(${target} UNKNOWN IMPORTED)
    set_target_properties(${target} PROPERTIES
      IMPORTED_LOCATION "${Bullet_${name}_${precision}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${Bullet_INCLUDE_DIR}"
      INTERFACE_BULLET_PRECISION ${precision}
      COMPATIBLE_INTERFACE_STRING BULLET_PRECISION)
    if(precision STREQUAL float64)
      set_property(TARGET ${target} PROPERTY INTERFACE_COMPILE_DEFINITIONS BT_USE_DOUBLE_PRECISION)
    endif()
    if(name MATCHES Inverse)
      set_property(TARGET ${target} PROPERTY INTERFACE_INCLUDE_DIRECTORIES "${BulletInverseDynamics_INCLUDE_DIRS}")
    endif()
    list(TRANSFORM ARGN PREPEND Bullet::)
    list(TRANSFORM ARGN APPEND "${suffix}")
    set_property(TARGET ${target} PROPERTY INTERFACE_LINK_LIBRARIES "${ARGN}")
  endif()
endfunction()

foreach(_bullet_precision float64 float32)
  set(_bullet_suffix "-float64")
  if(_bullet_precision STREQUAL float32)
    set(_bullet_suffix "")
  endif()
  set(BulletInverseDynamics_${_bullet_precision}_FOUND TRUE)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" LinearMath)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" Bullet3Common)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" BulletCollision LinearMath)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" BulletDynamics Collision LinearMath)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" BulletInverseDynamics Bullet3Common LinearMath)
  _bullet_target(${_bullet_precision} "${_bullet_suffix}" BulletInverseDynamicsUtils InverseDynamics Dynamics)
endforeach()

set(BulletInverseDynamics_LIBRARY ${Bullet_BulletInverseDynamics_float64_LIBRARY})
if(NOT BulletInverseDynamics_float64_FOUND)
  set(BulletInverseDynamics_LIBRARY ${Bullet_BulletInverseDynamics_float32_LIBRARY})
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BulletInverseDynamics
  REQUIRED_VARS BulletInverseDynamics_INCLUDE_DIRS BulletInverseDynamics_LIBRARY
  VERSION_VAR BulletInverseDynamics_VERSION
  REASON_FAILURE_MESSAGE "${_bullet_reason}")
