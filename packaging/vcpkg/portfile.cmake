# An overlay port: the sources are those of the tree that it is in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        assimp  MSQ_WITH_ASSIMP
        cgal    MSQ_WITH_CGAL
        hashes  MSQ_WITH_XXHASH
        isal    MSQ_WITH_ISAL
        json    MSQ_WITH_JSON
        tiff    MSQ_WITH_TIFF
        tools   MSQ_BUILD_TOOLS
)
# For libhwy, minizip and libisal.
vcpkg_find_acquire_program(PKGCONFIG)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}"
        -DMSQ_BUILD_EXAMPLES=OFF
        -DMSQ_BUILD_TESTS=OFF
        -DMSQ_BUILD_FUZZERS=OFF
        -DMSQ_WITH_PYTHON=OFF
)
vcpkg_cmake_install()
vcpkg_copy_pdbs()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/msq)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES AND EXISTS "${CURRENT_PACKAGES_DIR}/bin/msq${VCPKG_TARGET_EXECUTABLE_SUFFIX}")
    vcpkg_copy_tools(TOOL_NAMES msq AUTO_CLEAN)
endif()

file(REMOVE_RECURSE
    "${CURRENT_PACKAGES_DIR}/debug/include"
    "${CURRENT_PACKAGES_DIR}/debug/share"
    "${CURRENT_PACKAGES_DIR}/share/bash-completion"
    "${CURRENT_PACKAGES_DIR}/share/doc"
    "${CURRENT_PACKAGES_DIR}/share/man"
    "${CURRENT_PACKAGES_DIR}/share/zsh"
)
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
