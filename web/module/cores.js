// SPDX-License-Identifier: MIT
// Of the module with threads, instead of emscripten's own, which asks a navigator that not every node has.
mergeInto(LibraryManager.library, {
    emscripten_num_logical_cores: function () {
        return Module['cores'];
    },
});
