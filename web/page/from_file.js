// SPDX-License-Identifier: MIT
// Says what to do where the page is opened as a file: a browser runs no modules then, so this is none.
if (location.protocol === 'file:') {
  document.documentElement.lang = navigator.language.startsWith('zh') ? 'zh' : 'en';
  document.querySelector('#first .view').dataset.error =
    document.documentElement.lang === 'zh'
      ? '浏览器不允许此页面从文件运行：请在其文件夹中执行 python3 -m http.server，然后打开 http://localhost:8000/'
      : 'A browser runs no such page from a file. Run python3 -m http.server in its folder, and open http://localhost:8000/';
}
