# The program as it is installed: what it plays lies under share/seam, laid out as here, and is found from where the program
# lies (scenes/own_folders.hpp).
include(GNUInstallDirs)
install(TARGETS seam RUNTIME COMPONENT program)
set(share ${CMAKE_INSTALL_DATADIR}/seam)
seam_install_scenes(${share} program)
install(DIRECTORY baselines experiments DESTINATION ${share}/bench COMPONENT program PATTERN *.png EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/seam RENAME copyright COMPONENT program)
install(FILES completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME seam COMPONENT program)

# Its manual pages are its own help.
find_program(HELP2MAN help2man DOC "Makes the manual pages, where it is there")
if(HELP2MAN)
  set(manual ${CMAKE_CURRENT_BINARY_DIR}/manual)
  add_custom_command(OUTPUT ${manual}/seam.1 DEPENDS seam manual.sh VERBATIM
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/manual.sh $<TARGET_FILE:seam> ${PROJECT_VERSION} ${manual})
  add_custom_target(seam_manual ALL DEPENDS ${manual}/seam.1)
  install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endif()
