// SPDX-License-Identifier: MIT
// The checks in a worker of a page, with one thread and, cross-origin isolated, with all: node in_browser.js BROWSER
// DATA, in a folder with the package installed. BROWSER is Chromium or what takes its options; a server for it runs
// here, and ends when the page has said how it went.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';

const limit = 120; // seconds

const [browser, data] = process.argv.slice(2);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };

const page = `<!doctype html><script type="module">
const worker = new Worker('/worker.js', { type: 'module' });
const tell = (result) => fetch('/result', { method: 'POST', body: JSON.stringify(result) });
worker.onmessage = ({ data }) => tell(data);
worker.onerror = ({ message, filename, lineno }) =>
    tell({ count: 1, failures: [message ? \`\${message} (\${filename}:\${lineno})\` : 'the worker does not start'] });
</script>`;

const isolation = {
    'Cross-Origin-Opener-Policy': 'same-origin',
    'Cross-Origin-Embedder-Policy': 'require-corp',
};

// What a thread of the package fails of is thrown as the event that told of it.
const worker = `import * as rhw from '/node_modules/rhw/index.js';
import { check } from '/checks.js';
const read = async (name) => new Uint8Array(await (await fetch('/data/' + name)).arrayBuffer());
const threads = crossOriginIsolated ? navigator.hardwareConcurrency : 1;
const fail = (error) => postMessage({ count: 1, failures: [String(error?.stack ?? error)] });
addEventListener('error', (event) => {
    const { message, filename, lineno } = event.error instanceof ErrorEvent ? event.error : event;
    event.preventDefault(); // the page has nothing to add
    fail(\`\${message} (\${filename}:\${lineno})\`);
});
check(rhw, read, threads, (name) => '/data/' + name).then(postMessage, fail);`;

async function contentOf(path) {
    const made = { '/': page, '/worker.js': worker }[path];
    const [, first, ...rest] = normalize(path).split('/');
    return made ?? readFile(first === 'data' ? join(data, ...rest) : join('.', first, ...rest));
}

function serve(headers, told) {
    return createServer(async (request, response) => {
        Object.entries(headers).forEach(([name, value]) => response.setHeader(name, value));
        const path = decodeURIComponent(new URL(request.url, 'http://page').pathname);
        if (path === '/result') {
            const parts = [];
            for await (const part of request) {
                parts.push(part);
            }
            response.end();
            told(JSON.parse(Buffer.concat(parts)));
            return;
        }
        try {
            const content = await contentOf(path);
            response.setHeader('content-type', types[path === '/' ? '.html' : extname(path)] ?? 'application/octet-stream');
            response.end(content);
        } catch {
            response.writeHead(404).end();
        }
    });
}

async function listen(server) {
    server.listen(0, '127.0.0.1');
    await once(server, 'listening');
    return `http://127.0.0.1:${server.address().port}/`;
}

// What the page says, or else why it says nothing.
async function visit(headers) {
    const profile = await mkdtemp(join(tmpdir(), 'rhw-browser-'));
    let told;
    const answer = new Promise((resolve) => {
        told = resolve;
    });
    const server = serve(headers, told);
    const options = ['--headless', '--no-sandbox', '--disable-gpu', `--user-data-dir=${profile}`, await listen(server)];
    const shown = spawn(browser, options, { stdio: 'ignore' });
    const ended = once(shown, 'exit').then(([status]) => `${browser} ended with status ${status}`,
                                           ({ message }) => message);
    const late = new Promise((resolve) => {
        setTimeout(resolve, limit * 1000, `nothing was heard for ${limit} s`).unref();
    });
    const result = await Promise.race([answer, ended, late]);
    shown.kill();
    server.close();
    await ended;
    await rm(profile, { recursive: true, force: true, maxRetries: 10 });
    return typeof result === 'string' ? { count: 1, failures: [result] } : result;
}

for (const [where, headers] of [['worker of a page', {}], ['worker of an isolated page', isolation]]) {
    const { count, failures } = await visit(headers);
    failures.forEach((failure) => console.log(`${where}: ${failure}`));
    console.log(`${where}: ${count - failures.length} of ${count} passed`);
    process.exitCode ||= failures.length > 0 ? 1 : 0;
}
