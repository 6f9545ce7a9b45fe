# What `cmake --install` puts where, as two components: runtime, the shared libraries; development, the rest. Nothing in it
# names a folder of this machine: the tree may be moved.

include(CMakePackageConfigHelpers)
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/seam)
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  message(FATAL_ERROR "CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_INCLUDEDIR must be relative to CMAKE_INSTALL_PREFIX")
endif()

# A file of targets for each component, so that what one of them needs is not asked of the others' users.
foreach(component IN LISTS SEAM_COMPONENTS)
  string(REPLACE "-" "_" target seam_${component})
  install(TARGETS ${target} EXPORT seam-${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT seam-${component} NAMESPACE seam:: FILE seam-${component}-targets.cmake
    DESTINATION ${cmake_folder} COMPONENT development)
endforeach()

set(folders core/include/)
if("files" IN_LIST SEAM_COMPONENTS)
  list(APPEND folders files/include/)
endif()
foreach(folder arm bullet)
  if(SEAM_COMPONENTS MATCHES ${folder})
    list(APPEND folders ${folder}/include/)
  endif()
endforeach()
install(DIRECTORY ${folders} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

if(NOT BUILD_SHARED_LIBS)
  set(seam_static_files "yaml-cpp")
  set(seam_static_arm "BulletInverseDynamics;urdfdom;console_bridge;tinyxml2")
  set(seam_static_bullet "assimp")
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libseam${PROJECT_VERSION_MAJOR}
  RENAME copyright COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libseam-dev
  RENAME copyright COMPONENT development)

configure_package_config_file(cmake/seam-config.cmake.in seam-config.cmake INSTALL_DESTINATION ${cmake_folder}
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Until 1.0 a minor version may break what uses it.
write_basic_package_version_file(seam-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/seam-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/seam-config-version.cmake
  cmake/FindBulletInverseDynamics.cmake DESTINATION ${cmake_folder} COMPONENT development)

# seam_pc(NAME DESCRIPTION REQUIRES REQUIRES_STATIC LIBS_STATIC CFLAGS): NAME.pc for pkg-config.
function(seam_pc component description requires requires_static libs_static cflags)
  if(NOT component IN_LIST SEAM_COMPONENTS)
    return()
  endif()
  if(BUILD_SHARED_LIBS)
    set(requires_static "")
    set(libs_static "")
  endif()
  file(RELATIVE_PATH to_prefix /${pc_folder} /)
  string(REGEX REPLACE "/$" "" to_prefix "${to_prefix}")
  configure_file(cmake/seam.pc.in seam-${component}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/seam-${component}.pc DESTINATION ${pc_folder} COMPONENT development)
endfunction()
seam_pc(core "Movement primitives, learned, joined and played" "eigen3" "" "" "")
seam_pc(files "Movement primitives and sequences as YAML files" "seam-core = ${PROJECT_VERSION}" "yaml-cpp" "" "")
foreach(precision double single)
  set(end "")
  set(suffix "-float64")
  set(flag "-DSEAM_BULLET_FLOAT64")
  if(precision STREQUAL "single")
    set(end "-float32")
    set(suffix "")
    set(flag "-DSEAM_BULLET_FLOAT32")
  endif()
  seam_pc(arm${end} "Movement primitives on an arm: its model and control (${precision} precision)"
    "seam-core = ${PROJECT_VERSION}" "urdfdom console_bridge tinyxml2"
    "-lBulletInverseDynamics${suffix} -lBullet3Common${suffix} -lLinearMath${suffix}" "${flag}")
  seam_pc(bullet${end} "Movement primitives on an arm in Bullet (${precision} precision)"
    "seam-arm${end} = ${PROJECT_VERSION} bullet${suffix}" "assimp" "" "")
endforeach()

if(PROJECT_IS_TOP_LEVEL)
  include(package)
endif()
