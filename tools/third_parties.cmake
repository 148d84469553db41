# What reads scenes and writes results, beside Kokkos and Eigen: HDF5, toml++, muparser.
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(PkgConfig QUIET)

# FindHDF5 names curl, crypto, sz and z beside a shared libhdf5, which needs none of them from us.
add_library(freshet_hdf5 INTERFACE)
set(hdf5_libraries ${HDF5_C_LIBRARIES})
list(FILTER hdf5_libraries INCLUDE REGEX "/libhdf5(_serial)?\\.(so|dylib)")
if(NOT hdf5_libraries)
  set(hdf5_libraries ${HDF5_C_LIBRARIES})  # static: the extras are needed
endif()
target_link_libraries(freshet_hdf5 INTERFACE ${hdf5_libraries})
target_include_directories(freshet_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})

# A library that ships a CMake package on some systems and only a pkg-config file on others.
function(freshet_third_party alias package target module)
  add_library(${alias} INTERFACE)
  find_package(${package} CONFIG QUIET)
  if(NOT TARGET ${target})
    if(NOT PkgConfig_FOUND)
      message(FATAL_ERROR "${package} not found: no CMake package, and no pkg-config to ask. Call tools/setup, or install it.")
    endif()
    pkg_check_modules(${alias}_pkg REQUIRED IMPORTED_TARGET ${module})
    set(target PkgConfig::${alias}_pkg)
  endif()
  target_link_libraries(${alias} INTERFACE ${target})
endfunction()
freshet_third_party(freshet_toml tomlplusplus tomlplusplus::tomlplusplus tomlplusplus)
freshet_third_party(freshet_muparser muparser muparser::muparser muparser)
