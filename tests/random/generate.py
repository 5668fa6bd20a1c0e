#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Random GLSL programs that mean one thing: arithmetic, control flow, calls, memory, images, barriers and atomics.

Every program ends, no two invocations exchange words without a barrier, and floats are cleaned of NaN before their bits
show, because which NaN an operation gives is nobody's promise. Fragments read nothing that is written: a derivative
would read what the partner pixel writes. Program N of a seed is the same on every machine.
usage: generate.py SEED FIRST COUNT FOLDER, which writes rN.comp or rN.frag
"""
import os
import random
import sys

COUNTERS = ('atomicAdd', 'atomicMin', 'atomicMax', 'atomicAnd', 'atomicOr', 'atomicXor')
OWN = 8  # words of an invocation

HEAD = '''#version 450
layout(set = 0, binding = 0) uniform Numbers { vec4 numbers[8]; ivec4 wholes[8]; };
layout(set = 0, binding = 1) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 2) buffer Own { uint own[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) uniform sampler2D picture;
layout(set = 0, binding = 5, rgba32f) uniform image2D canvas;
layout(set = 0, binding = 6) uniform sampler2D levels;
layout(set = 0, binding = 7) uniform sampler2DShadow shadow;
layout(set = 0, binding = 8) uniform sampler2D depths;
layout(push_constant) uniform Push { int count; float scale; } push;
#define PART(x, y) textureLodOffset(shadow, at, 0.0, ivec2(x, y))
float window(vec3 at) { return PART(-1, 0) + 2.0 * PART(0, 0) + 4.0 * PART(1, 1) + 8.0 * PART(0, 1); }
float turns(vec3 at)
{
    float a = PART(-1, 0), b = sin(at.x + a), c = PART(0, 0) * b, d = cos(at.y + c);
    return PART(1, 0) * d + PART(1, 1) * sin(d - c);
}
float texel(int x, int y, int outside)
{
    ivec2 at = ivec2(x & 31, y & 31) - 8;
    at.x = (outside & 3) == 2 ? 0x7fffffff - (x & 7) : (outside & 3) == 3 ? -0x7fffffff - 1 + (x & 7) : at.x;
    at.y = (outside & 12) == 8 ? 0x7fffffff - (y & 7) : (outside & 12) == 12 ? -0x7fffffff - 1 + (y & 7) : at.y;
    return texelFetch(depths, at, 0).x;
}
float clean(float x) { return isnan(x) ? 7.0 : x; }
'''
COMPUTE = '''layout(local_size_x = %d) in;
shared uint pool[%d];
int self() { return int(gl_GlobalInvocationID.x); }
int here() { return int(gl_LocalInvocationIndex); }
'''
FRAGMENT = '''layout(location = 0) in vec4 smooth_in;
layout(location = 1) flat in ivec2 flat_in;
layout(location = 0) out vec4 color;
int self() { return int(gl_FragCoord.x) + 16 * int(gl_FragCoord.y); }
int here() { return flat_in.x; }
'''


class Program:
    """One program while it is written."""

    def __init__(self, seed, number):
        self.random = random.Random(f'{seed} {number}')
        self.is_compute = self.random.random() < 0.6
        self.is_pure = not self.is_compute and self.random.random() < 0.5  # it leaves a colour alone
        self.size = self.random.choice((1, 8, 20, 32, 64, 136))
        self.has_barriers = self.is_compute and self.random.random() < 0.4
        self.is_ordered = self.random.random() < (0.2 if self.is_compute else 0.6)  # what atomics return shows
        # Groups go through its code in steps, in loops too: no invocation leaves by itself, and none has arrays.
        self.has_steps = self.random.random() < 0.4
        self.counters = []  # of loops around that all invocations go through together
        self.breaks = 0  # out of a loop, by some invocations alone
        self.lines = []
        self.names = 0
        self.scopes = [[]]
        self.fixed = set()  # counters of loops, and parameters
        self.depth = 0
        self.loops = 0
        self.switches = 0
        self.is_uniform = True  # all invocations come here
        self.in_function = False
        self.functions = []

    def pick(self, *choices):
        return self.random.choice(choices)

    def line(self, text):
        self.lines.append('    ' * self.depth + text)

    def new_name(self, kind, is_fixed=False):
        self.names += 1
        name = f'{kind[0]}{self.names}'
        self.scopes[-1].append((kind, name))
        if is_fixed:
            self.fixed.add(name)
        return name

    def variables(self, kind, assigned=False):
        return [name for scope in self.scopes for k, name in scope
                if k == kind and not (assigned and name in self.fixed)]

    # Expressions

    def expression(self, kind, depth=3):
        return getattr(self, kind)(depth)

    def leaf(self, kind, others):
        names = self.variables(kind)
        if names and self.random.random() < 0.6:
            return self.random.choice(names)
        return self.random.choice(others)

    def index(self, depth, count):
        return f'({self.expression("int", depth - 1)}) & {count - 1}'

    def float(self, depth):
        r = self.random
        if depth <= 0:
            ends = [f'{r.choice((0.5, 1.0, -2.0, 3.25, 0.125, 100.0, -0.75)):.3f}', 'push.scale',
                    f'numbers[{r.randrange(8)}].{r.choice("xyzw")}', f'float({self.leaf("int", ["here()"])})']
            if not self.is_compute:
                ends += [f'smooth_in.{r.choice("xyzw")}', f'gl_FragCoord.{r.choice("xyz")}']
            return self.leaf('float', ends)
        e = lambda: self.expression('float', depth - 1)
        forms = ['({0} + {1})', '({0} - {1})', '({0} * {1})', '({0} / {1})', 'min({0}, {1})', 'max({0}, {1})',
                 'abs({0})', 'floor({0})', 'fract({0})', 'sqrt(abs({0}))', 'sin({0})', 'cos({0})', 'exp2(min({0}, 8.0))',
                 'log2(abs({0}) + 0.5)', 'mix({0}, {1}, {2})', 'clamp({0}, -4.0, 4.0)', '(-({0}))', 'sign({0})',
                 'step({0}, {1})', 'smoothstep(-1.0, 2.0, {0})', 'inversesqrt(abs({0}) + 1.0)', 'roundEven({0})',
                 'dot(vec3({0}, {1}, {2}), numbers[1].xyz)', 'length(vec2({0}, {1}))', 'pow(abs({0}), 1.5)', 'atan({0}, {1})']
        if not self.in_function and not self.is_compute:
            forms += ['dFdx({0})', 'dFdy({0})', 'texture(picture, vec2({0}, {1})).y', 'texture(levels, vec2({0}, {1})).z',
                      'texture(shadow, vec3({0}, {1}, {2}))']
        forms += ['textureLod(picture, vec2({0}, {1}), 0.0).x', 'window(vec3({0}, {1}, {2}))', 'texel({0}, {1}, {2})']
        choice = r.randrange(len(forms) + 4)
        if choice < len(forms):
            kind = 'int' if forms[choice].startswith('texel(') else 'float'
            return forms[choice].format(*(self.expression(kind, depth - 1) for _ in range(3)))
        return self.pick(f'({self.expression("bool", depth - 1)} ? {e()} : {e()})',
                         f'float({self.expression("int", depth - 1)})',
                         f'numbers[{self.index(depth, 8)}].{r.choice("xyzw")}',
                         f'float({self.expression("uint", depth - 1)})')

    def int(self, depth):
        r = self.random
        if depth <= 0:
            ends = [f'({r.randrange(-20, 20)})', 'push.count', f'wholes[{r.randrange(8)}].{r.choice("xyzw")}', 'self()',
                    'here()']
            return self.leaf('int', ends)
        e = lambda: self.expression('int', depth - 1)
        forms = ['({0} + {1})', '({0} - {1})', '({0} * {1})', '({0} / {1})', '({0} & {1})', '({0} | {1})', '({0} ^ {1})',
                 '(~({0}))', '({0} << ({1} & 31))', '({0} >> ({1} & 31))', 'min({0}, {1})', 'max({0}, {1})', 'abs({0})',
                 'bitCount({0})', 'findMSB({0})', 'findLSB({0})', 'bitfieldExtract({0}, 3, 9)',
                 'bitfieldInsert({0}, {1}, 4, 11)', 'bitfieldReverse({0})']
        choice = r.randrange(len(forms) + 5)
        if choice < len(forms):
            return forms[choice].format(e(), e())
        return self.pick(f'({self.expression("bool", depth - 1)} ? {e()} : {e()})',
                         f'int({self.expression("float", depth - 1)})', f'int({self.expression("uint", depth - 1)})',
                         f'wholes[{self.index(depth, 8)}].{r.choice("xyzw")}',
                         f'floatBitsToInt(clean({self.expression("float", depth - 1)}))')

    def uint(self, depth):
        r = self.random
        if depth <= 0:
            return self.leaf('uint', [f'{r.randrange(50)}u', f'source[{r.randrange(80)}]', 'uint(here())'])
        e = lambda: self.expression('uint', depth - 1)
        forms = ['({0} + {1})', '({0} - {1})', '({0} * {1})', '({0} / {1})', '({0} % {1})', '({0} & {1})', '({0} ^ {1})',
                 '({0} >> ({1} & 31u))', 'min({0}, {1})', 'max({0}, {1})', 'uint(bitCount({0}))']
        choice = r.randrange(len(forms) + 5)
        if choice < len(forms):
            return forms[choice].format(e(), e())
        return self.pick(f'({self.expression("bool", depth - 1)} ? {e()} : {e()})',
                         f'source[uint({self.expression("int", depth - 1)}) % 96u]', f'uint({self.expression("int", depth - 1)})',
                         f'own[{OWN} * self() + ({self.index(depth, OWN)})]' if self.is_compute else 'source[3]',
                         f'packHalf2x16(vec2(clean(clamp('
                         f'{self.expression("float", depth - 1)}, -9.0, 9.0)), 1.5))')

    def bool(self, depth):
        if depth <= 0:
            return self.leaf('bool', ['true', 'false', '(here() > 3)', '(push.count > 2)'])
        kind = self.pick('float', 'int', 'uint')
        e = lambda: self.expression(kind, depth - 1)
        b = lambda: self.expression('bool', depth - 1)
        forms = ['({0} < {1})', '({0} <= {1})', '({0} == {1})', '({0} != {1})', '({0} > {1})']
        choice = self.random.randrange(len(forms) + 4)
        if choice < len(forms):
            return forms[choice].format(e(), e())
        return self.pick(f'!({b()})', f'({b()} && {b()})', f'({b()} || {b()})', f'({b()} ^^ {b()})')

    def uniform(self):
        """A number that all invocations agree on."""
        counters = self.counters + self.variables('counter')
        if counters and self.random.random() < 0.5:
            return f'{self.random.choice(counters)} + {self.random.randrange(3)}'
        return self.pick('push.count & 3', f'wholes[{self.random.randrange(8)}].x & 3', '2',
                         f'(push.count & 0) + {self.random.randrange(3)}')

    # Statements

    def block(self, statements, is_uniform=False):
        before, self.is_uniform = self.is_uniform, self.is_uniform and is_uniform
        self.depth += 1
        self.scopes.append([])
        for _ in range(statements):
            self.statement()
        self.scopes.pop()
        self.depth -= 1
        self.is_uniform = before

    def statement(self):
        weights = {'declare': 4, 'assign': 5, 'branch': 3, 'loop': 2, 'choose': 1, 'keep': 0 if self.is_pure else 2,
                   'array': 1, 'leave': 1.5, 'count': 0 if self.is_pure else 1, 'call': 1, 'draw': 0.5,
                   'share': 3 if self.has_barriers else 0}
        if self.depth > 4:
            weights.update(branch=0, loop=0, choose=0)
        if self.is_ordered and not self.is_compute:
            weights.update(leave=3, loop=4 if self.depth < 3 else 0, count=0 if self.is_pure else 3)
        if self.has_steps:
            weights.update(array=0, choose=0, chain=8 if self.counters else 1, loop=2.5 * weights['loop'])
        kind = self.random.choices(list(weights), list(weights.values()))[0]
        getattr(self, f'write_{kind}')()

    def write_declare(self):
        kind = self.pick('float', 'int', 'uint', 'bool')
        value = self.expression(kind)
        self.line(f'{kind} {self.new_name(kind)} = {value};')

    def write_assign(self):
        kind = self.pick('float', 'int', 'uint', 'bool')
        names = self.variables(kind, assigned=True)
        if names:
            self.line(f'{self.random.choice(names)} = {self.expression(kind)};')

    def write_branch(self):
        is_uniform = self.random.random() < 0.3
        self.line(f'if ({f"({self.uniform()}) > 1" if is_uniform else self.expression("bool")}) {{')
        self.block(self.random.randrange(1, 4), is_uniform)
        if self.random.random() < 0.5:
            self.line('} else {')
            self.block(self.random.randrange(1, 4), is_uniform)
        self.line('}')

    def write_loop(self):
        is_uniform = self.has_steps or self.random.random() < 0.4
        count = self.uniform() if is_uniform else f'({self.expression("int", 1)}) & 7'
        self.scopes.append([])
        name = self.new_name('int', is_fixed=True)
        form = self.random.randrange(3)
        self.loops += 1
        switches, self.switches = self.switches, 0
        is_shared = is_uniform and self.is_uniform and not self.in_function
        breaks = self.breaks
        self.counters += [name] if is_shared else []
        if form == 0 and is_shared:
            self.write_rounds(name, count)
        elif form == 0:
            self.line(f'for (int {name} = 0; {name} < ({count}); {name}++) {{')
            self.block(self.random.randrange(1, 4), False)
            self.line('}')
        else:
            self.line(f'int {name} = 0;')
            self.line('do {' if form == 1 else f'while ({name} < ({count})) {{')
            self.depth += 1
            self.line(f'{name}++;')
            self.depth -= 1
            self.block(self.random.randrange(1, 4), is_shared)
            self.line(f'}} while ({name} < ({count}));' if form == 1 else '}')
        self.counters = self.counters[:-1] if is_shared else self.counters
        self.switches = switches
        self.loops -= 1
        self.scopes[-2] += [(kind, n) for kind, n in self.scopes[-1] if form > 0]
        if form > 0 and is_shared and self.breaks == breaks:  # those that come out have counted alike
            self.scopes[-2].append(('counter', name))
        self.scopes.pop()

    def write_rounds(self, name, count):
        """A loop that carries a number which all invocations share, and changes it among what they do not share."""
        carried = self.new_name('int', is_fixed=True)
        self.line(f'int {carried} = push.count;')
        self.line(f'for (int {name} = 0; {name} < ({count}); {name}++) {{')
        self.block(self.random.randrange(1, 3), True)
        self.depth += 1
        wheres = self.variables('float', assigned=True)
        where = self.random.choice(wheres) if wheres else None
        if where:
            self.line(f'{where} += float({carried});')
        self.line(f'{carried} = {carried} * 3 + {name};')
        if where:
            self.line(f'{where} -= 0.5 * float({carried});')
        self.depth -= 1
        self.block(self.random.randrange(1, 3), True)
        self.line('}')

    def write_chain(self):
        """A value that waits for one function after the other."""
        first, second = self.pick('log2', 'exp2', 'sin', 'atan'), self.pick('exp2', 'cos', 'tanh')
        value = f'{second}(1.5 * {first}(inversesqrt(abs({self.expression("float")}) + 0.5) * 3.0))'
        self.line(f'float {self.new_name("float")} = {value};')

    def write_choose(self):
        self.line(f'switch (({self.expression("int", 2)}) & 3) {{')
        self.switches += 1
        for case in self.random.sample(range(4), self.random.randrange(1, 4)):
            self.line(f'case {case}:')
            self.block(self.random.randrange(1, 3))
            if self.random.random() < 0.7:
                self.line('    break;')
        if self.random.random() < 0.5:
            self.line('default:')
            self.block(1)
            self.line('    break;')
        self.switches -= 1
        self.line('}')

    def write_keep(self):
        kind = self.pick('float', 'int', 'uint')
        value = self.expression(kind)
        text = {'float': f'floatBitsToUint(clean({value}))', 'int': f'uint({value})', 'uint': value}[kind]
        self.line(f'own[{OWN} * self() + ({self.index(2, OWN)})] = {text};')

    def write_array(self):
        self.names += 1
        name = f'a{self.names}'
        self.line(f'float {name}[4] = float[4]({", ".join(self.expression("float", 1) for _ in range(4))});')
        self.line(f'{name}[{self.index(2, 4)}] = {self.expression("float")};')
        value = self.index(2, 4)
        self.line(f'float {self.new_name("float")} = {name}[{value}];')

    def write_leave(self):
        ways = (['break', 'continue'] if self.loops and not self.switches else []) + \
               (['return 0.5'] if self.in_function else [] if self.has_barriers else ['return']) + \
               (['discard'] if not self.is_compute and self.random.random() < 0.5 else [])
        if self.has_steps:
            if self.is_uniform and self.counters:
                self.line(f'if (({self.uniform()}) > {self.random.randrange(3)}) {{ {self.pick("break", "continue")}; }}')
        elif ways and self.depth > 1:
            way = self.random.choice(ways)
            self.breaks += way == 'break'
            self.line(f'if ({self.expression("bool", 2)}) {{ {way}; }}')

    def write_count(self):
        if self.is_ordered and not self.in_function and self.random.random() < 0.5:
            value = self.expression('uint', 1)
            if not self.is_compute:  # a derivative would read what the partner pixel gets
                condition = f'if (({self.uniform()}) > 1) ' if self.random.random() < 0.7 else ''
                place = f'own[{OWN} * self() + {self.random.randrange(OWN)}]'
                self.line(f'{condition}{{ {place} = atomicAdd(counters[7], {value}); }}')
                return
            operation = self.pick('atomicAdd(counters[7]', 'atomicExchange(counters[8]',
                                  f'atomicCompSwap(counters[9], {self.expression("uint", 1)}')
            self.line(f'uint {self.new_name("uint")} = {operation}, {value});')
            return
        which = self.random.randrange(len(COUNTERS))
        self.line(f'{COUNTERS[which]}(counters[{which}], {self.expression("uint", 2)});')

    def write_call(self):
        if self.functions and not self.in_function:
            function = self.random.choice(self.functions)
            inout = self.variables('int', assigned=True)
            if inout:
                value = self.expression('float', 2)
                variable = self.random.choice(inout)
                self.line(f'float {self.new_name("float")} = {function}({value}, {variable});')

    def write_draw(self):
        if self.is_compute:
            value = self.expression('float', 2)
            self.line(f'imageStore(canvas, ivec2(self() & 31, self() >> 5), vec4(clean({value}), 1.0, 0.0, 1.0));')
            self.line(f'float {self.new_name("float")} = imageLoad(canvas, ivec2(self() & 31, self() >> 5)).x;')

    def write_share(self):
        if not self.is_uniform or self.in_function or self.loops or self.switches:
            return
        is_looped = self.random.random() < 0.4
        value, reach = self.expression('uint', 2), self.random.randrange(1, self.size + 1)
        name = self.new_name('uint')
        self.line(f'uint {name} = 0u;')
        if is_looped:
            self.names += 1
            self.line(f'for (int k{self.names} = 0; k{self.names} < ({self.uniform()}); k{self.names}++) {{')
            self.depth += 1
        self.line(f'pool[here()] = {value} + {name};')
        self.line('barrier();')
        self.line(f'{name} += pool[(here() + {reach}) % {self.size}];')
        self.line('barrier();')
        if is_looped:
            self.depth -= 1
            self.line('}')

    # The whole

    def write_function(self):
        name = f'function{len(self.functions)}'
        self.line(f'float {name}(float x, inout int n)')
        self.line('{')
        self.in_function = True
        self.scopes.append([('float', 'x'), ('int', 'n')])
        self.block(self.random.randrange(2, 6))
        value = self.expression('float')
        self.line(f'    return {value};')
        self.scopes.pop()
        self.in_function = False
        self.line('}')
        self.functions.append(name)

    def text(self):
        self.lines = [HEAD + (COMPUTE % (self.size, self.size) if self.is_compute else FRAGMENT)]
        for _ in range(self.random.randrange(3)):
            self.write_function()
        self.line('void main()')
        self.line('{')
        self.scopes.append([])
        self.depth = 1
        for kind in ('float', 'int', 'uint', 'bool'):
            value = self.expression(kind, 1)
            self.line(f'{kind} {self.new_name(kind)} = {value};')
        if not self.is_compute:
            self.line('color = vec4(0.25);')
            self.line('vec4 mapped = texture(levels, smooth_in.xy) + 2.0 * texture(picture, smooth_in.zw) +')
            self.line('    4.0 * texture(picture, smooth_in.xy);')
        self.depth = 0
        self.block(self.random.randrange(6, 16), True)
        self.depth = 1
        for word, kind in enumerate(() if self.is_pure else ('float', 'int', 'uint')):
            value = self.variables(kind)[0]
            bits = {'float': f'floatBitsToUint(clean({value}))', 'int': f'uint({value})', 'uint': value}[kind]
            self.line(f'own[{OWN} * self() + {word}] = {bits};')
        if not self.is_pure:
            at = ', '.join(self.expression('int', 1) for _ in range(3))
            self.line(f'own[{OWN} * self() + 3] = floatBitsToUint(texel({at}));')
        if not self.is_compute:
            e = lambda: self.expression('float', 1)
            values = ', '.join((f'clean({e()})', f'texture(levels, vec2({e()}, {e()})).x',
                                f'window(vec3({e()}, {e()}, {e()}))', f'texture(shadow, vec3({e()}, {e()}, {e()})) + '
                                f'clean(turns(vec3({e()}, {e()}, 0.5)))'))
            self.line(f'color = vec4({values}) + mapped;')
        self.lines.append('}')
        return '\n'.join(self.lines) + '\n'


def main(seed, first, count, folder):
    for number in range(first, first + count):
        program = Program(seed, number)
        text = program.text()
        with open(os.path.join(folder, f'r{number}.{"comp" if program.is_compute else "frag"}'), 'w',
                  encoding='utf-8') as file:
            file.write(text)


if __name__ == '__main__':
    main(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
