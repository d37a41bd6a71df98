# SOCI is libraries without a package for CMake: the target soci, with its backends for SQLite and
# PostgreSQL, whose headers include those of libpq and of sqlite3.
function(gonio_find_soci)
  if(TARGET soci)
    return()
  endif()
  find_path(SOCI_INCLUDE_DIR soci/soci.h REQUIRED)
  find_path(SOCI_LIBPQ_INCLUDE_DIR libpq-fe.h PATH_SUFFIXES postgresql REQUIRED)
  find_path(SOCI_SQLITE3_INCLUDE_DIR sqlite3.h REQUIRED)
  add_library(soci INTERFACE IMPORTED GLOBAL)
  target_include_directories(soci SYSTEM INTERFACE ${SOCI_INCLUDE_DIR} ${SOCI_LIBPQ_INCLUDE_DIR}
                                                   ${SOCI_SQLITE3_INCLUDE_DIR})
  # The core last: the backends need it.
  foreach(part sqlite3 postgresql core)
    find_library(SOCI_${part}_LIBRARY soci_${part} REQUIRED)
    target_link_libraries(soci INTERFACE ${SOCI_${part}_LIBRARY})
  endforeach()
endfunction()
