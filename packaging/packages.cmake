# Debian packages by CPack, one for each component of what is installed.
set(contact "softscope authors <unknown@softscope.invalid>")
if(DEFINED ENV{DEBEMAIL} AND DEFINED ENV{DEBFULLNAME})  # as Debian's own tools take them
  set(contact "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(release ${PROJECT_VERSION}-1)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${contact})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "dense 3-D models of soft tissue from stereo endoscopes")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH where that is set
# softscope_package(<component> <package> <section> <depends> <what it is>): with copyright and
# changelog, which every Debian package has.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian
  "softscope (${release}) unstable; urgency=medium\n\n  * See the project's commits.\n\n"
  " -- ${contact}  ${today}\n")
execute_process(COMMAND gzip -9nf ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian)
function(softscope_package component package section depends description)
  string(TOUPPER ${component} name)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${name}_DESCRIPTION "${description}" PARENT_SCOPE)
  install(FILES copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endfunction()

set(about "softscope reconstructs soft tissue from stereo endoscope images: a
live, deforming, coloured model with the pose of the endoscope. It judges
the result against ground truth and writes reports and figures. Research
use only, not for diagnosis.")
softscope_package(program softscope science "fonts-liberation" "${about}

This package holds the program, its manual and its completions.")
softscope_package(library libsoftscope${soname} libs "fonts-liberation" "${about}

This package holds the shared library.")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/shlibs
  "libsoftscope ${soname} libsoftscope${soname} (= ${release})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_BINARY_DIR}/triggers ${CMAKE_CURRENT_BINARY_DIR}/shlibs)
softscope_package(development libsoftscope-dev libdevel "libsoftscope${soname} (= ${release})"
  "${about}

This package holds the headers and the files for find_package(softscope)
of CMake.")
if(SOFTSCOPE_HAS_PYTHON)
  softscope_package(python python3-softscope python "${SOFTSCOPE_PYTHON_DEPENDS}, fonts-liberation"
    "${about}

This package holds the module softscope for Python 3.")
endif()
include(CPack)
