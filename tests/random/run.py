#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Write random programs, write them as C, compile that in bulk, and compare it with the interpreter.

Every second chunk is compiled for the wider instruction set, where the machine has it. With --machine TOOL the programs
are compared as generated machine code instead, with all registers and with few.
"""
import argparse
import concurrent.futures
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import generate  # noqa: E402

CHUNK = 10  # programs of a file


def has_wide():
    try:
        with open('/proc/cpuinfo', encoding='ascii', errors='replace') as file:
            return ' avx2 ' in file.read()
    except OSError:
        return False


def compare_machine(tool, options, vertex):
    """Return 0 if machine code leaves what the interpreter does."""
    with tempfile.TemporaryDirectory() as folder:
        generate.main(options.seed, options.first, options.count, folder)
        command = [tool, folder, str(options.first), str(options.count), vertex]
        return max(subprocess.run(command, env={**os.environ, 'RHW_JIT': registers}, check=False).returncode
                   for registers in ('16', '6'))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--compiler')
    parser.add_argument('--flags', default='')
    parser.add_argument('--wide-flags', default='')
    parser.add_argument('--emit')
    parser.add_argument('--machine')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--first', type=int, default=0)
    parser.add_argument('--count', type=int, default=12)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--keep', help='folder to leave everything in')
    parser.add_argument('--libraries', nargs=argparse.REMAINDER, default=[])
    options = parser.parse_args()
    here = os.path.dirname(os.path.abspath(__file__))
    if options.machine:
        return compare_machine(options.machine, options, os.path.join(here, 'random.vert'))
    flags = options.flags.split()
    wide = options.wide_flags.split() if has_wide() else []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or temporary
        os.makedirs(folder, exist_ok=True)
        generate.main(options.seed, options.first, options.count, folder)
        subprocess.run([options.emit, folder, str(options.first), str(options.count), str(CHUNK),
                        os.path.join(here, 'random.vert')], check=True)
        chunks = [f'chunk_{i}.c' for i in range((options.count + CHUNK - 1) // CHUNK)] + ['words.c']

        def compile_chunk(number):
            source = os.path.join(folder, chunks[number])
            warnings = ['-Wall', '-Wextra', '-Wshadow', '-Wconversion', '-Werror', '-Wno-psabi']
            subprocess.run([options.compiler, '-std=gnu17', '-O1', *warnings, '-DRHW_ISA_SUFFIX=baseline', f'-I{here}', *flags,
                            *(wide if number % 2 else []), '-c', source, '-o', source[:-2] + '.o'], check=True)
            return source[:-2] + '.o'
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            objects = list(pool.map(compile_chunk, range(len(chunks))))
        program = os.path.join(folder, 'compare')
        subprocess.run([options.compiler, '-o', program, *objects, *options.libraries], check=True)
        return subprocess.run([program], check=False).returncode


if __name__ == '__main__':
    sys.exit(main())
