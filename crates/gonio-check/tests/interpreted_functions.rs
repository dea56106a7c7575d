//! The interpreter's built-in functions and operators, compared with the driver's over a grid of arguments.
//!
//! Each case is a statement of a fragment shader in which `a` and `b` are floats and `i` and `j` integers, one pair of
//! them for each pixel. Both run the same text. Differences are measured relative to the larger of 1 and the driver's
//! number. The tolerances are those of this driver (Mesa 22.3, llvmpipe), which computes some functions by short
//! polynomials; the interpreter's own are exact to the last bit.
#![allow(clippy::unwrap_used)]

use gonio_check::testbench::TILE;
use gonio_gl::{Gl, HeadlessContext};
use gonio_glsl::Stage;
use gonio_interpreter::{PointValues, RunOptions, StageInputs, compile, run};
use gonio_render::user_program::{Stream, StreamMesh, TileTarget, UserProgram};

/// The last bits: additions and multiplications in another order, or fused ones.
const BITS: f32 = 1e-6;
/// exp2 and log2 of llvmpipe are polynomials with errors of about 1e-6 (lp_bld_arit.c); powers multiply them.
const POWERS: f32 = 2e-5;
/// Mesa computes asin and acos by a polynomial with an error of 2e-4 or less (nir_builtin_builder.c).
const ARCS: f32 = 5e-4;

/// The arguments that a statement is compared for.
#[derive(Clone, Copy, PartialEq)]
enum Arguments {
    All,
    /// Without infinities, NaN and numbers beyond 1e11: the specification leaves them open (section 4.7.1), and this
    /// driver removes multiplications by zero, negates comparisons and flushes denormal numbers to zero.
    Finite,
}
use Arguments::{All, Finite};

/// Statements, tolerances and arguments.
const CASES: &[(&str, f32, Arguments)] = &[
    // Operators on floats, also of zero, infinity and NaN.
    ("r = vec4(a + b, a - b, a * b, a / b);", BITS, All),
    ("r = vec4(-a, +a, float(a < b) + 2.0 * float(a <= b), float(a > b) + 2.0 * float(a >= b));", 0.0, All),
    ("r.x = float(a == b) + 2.0 * float(a != b) + 4.0 * float(!(a < b));", 0.0, All),
    (
        "r.xyz = vec3(lessThan(vec3(a, b, 0.0), vec3(b, a, a))); r.w = float(all(equal(vec2(a, b), vec2(b, a))));",
        0.0,
        All,
    ),
    (
        "r.xyz = vec3(greaterThanEqual(vec3(a, b, 0.0), vec3(b, a, a))); r.w = float(any(notEqual(vec2(a, b), vec2(b, a))));",
        0.0,
        All,
    ),
    // Section 8.1.
    ("r.xy = vec2(radians(a), degrees(b));", BITS, All),
    ("if (abs(a) < 1000.0) r.xy = vec2(sin(a), cos(a));", 2e-6, All),
    ("if (abs(a) < 1.5) r.x = tan(a);", 1e-5, All),
    ("if (abs(a) <= 1.0) r.xy = vec2(asin(a), acos(a));", ARCS, All),
    ("r.x = atan(a);", 1e-5, Finite),
    ("if (a != 0.0 || b != 0.0) r.x = atan(a, b);", 1e-5, Finite),
    ("if (abs(a) < 80.0) r.xy = vec2(sinh(a), cosh(a));", POWERS, All),
    ("r.x = tanh(a);", POWERS, Finite),
    ("if (abs(a) < 1e4) r.x = asinh(a);", POWERS, All),
    ("if (a >= 1.0 && a < 1e4) r.x = acosh(a);", 1e-4, All),
    ("if (abs(a) < 0.999) r.x = atanh(a);", POWERS, Finite),
    // Section 8.2.
    ("if (a >= 0.0 && abs(b) < 20.0) r.x = pow(a, b);", 1e-4, Finite),
    ("if (abs(a) < 80.0) r.xy = vec2(exp(a), exp2(a));", POWERS, All),
    ("if (a > 0.0) r.xy = vec2(log(a), log2(a));", POWERS, All),
    ("if (a >= 0.0) r.x = sqrt(a);", BITS, All),
    ("if (a > 0.0) r.x = inversesqrt(a);", BITS, All),
    // Section 8.3.
    ("r = vec4(abs(a), sign(a), floor(a), ceil(a));", 0.0, All),
    ("r = vec4(trunc(a), roundEven(a), fract(a), round(a * 1.01));", BITS, All),
    ("if (b != 0.0 && abs(a / b) < 1e5) r.x = mod(a, b);", 1e-5, Finite),
    ("float whole; r.x = modf(a, whole); r.y = whole;", BITS, Finite),
    ("r = vec4(min(a, b), max(a, b), clamp(a, -1.0, b < 0.0 ? 2.0 : 3.0), step(a, b));", 0.0, All),
    ("r.xyz = mix(vec3(a, 1.0, 2.0), vec3(b, 3.0, -1.0), 0.25); r.w = mix(a, b, a > 0.5);", BITS, All),
    ("if (abs(a) < 1e4 && abs(b) < 1e4) r.x = mix(1.0, a, b);", 1e-5, Finite),
    ("if (a < b && abs(a) < 1e9) r.xy = vec2(smoothstep(a, b, 0.3), smoothstep(a, b, b));", 1e-5, Finite),
    ("r.xy = vec2(isnan(a), isinf(a));", 0.0, All),
    (
        "r.x = float(floatBitsToInt(a) >> 16); r.y = float(floatBitsToUint(a) & 0xffffu); r.z = intBitsToFloat(floatBitsToInt(b));",
        0.0,
        All,
    ),
    ("if (abs(a) < 1e9) r.x = fma(a, 2.0, b);", BITS, All),
    ("int e; r.x = frexp(a, e); r.y = float(e);", 0.0, Finite),
    ("if (abs(a) < 1e9) r.x = ldexp(a, clamp(i, -20, 20));", 0.0, All),
    // Section 8.4, by 16 bits.
    ("uint p = packUnorm2x16(vec2(a, b)); r.xy = vec2(p & 0xffffu, p >> 16); r.zw = unpackUnorm2x16(p);", BITS, All),
    ("uint p = packSnorm2x16(vec2(a, b)); r.xy = vec2(p & 0xffffu, p >> 16); r.zw = unpackSnorm2x16(p);", BITS, All),
    (
        "uint p = packUnorm4x8(vec4(a, b, 0.3, 0.7)); r.xy = vec2(p & 0xffffu, p >> 16); r.zw = unpackUnorm4x8(p).xy;",
        BITS,
        All,
    ),
    (
        "uint p = packSnorm4x8(vec4(a, b, -0.3, 0.7)); r.xy = vec2(p & 0xffffu, p >> 16); r.zw = unpackSnorm4x8(p).xy;",
        BITS,
        All,
    ),
    ("uint p = packHalf2x16(vec2(a, b)); r.xy = vec2(p & 0xffffu, p >> 16); r.zw = unpackHalf2x16(p);", BITS, Finite),
    // Section 8.5.
    (
        "if (abs(a) < 1e9 && abs(b) < 1e9) r.xyz = vec3(length(vec3(a, b, 2.0)), distance(vec2(a, 1.0), vec2(1.0, b)), dot(vec4(a), vec4(b, 1.0, -1.0, 0.5)));",
        1e-5,
        Finite,
    ),
    (
        "if (abs(a) < 1e9 && abs(b) < 1e9) { r.xyz = cross(vec3(a, b, 1.0), vec3(0.5, 2.0, b)); r.w = length(a); }",
        1e-5,
        Finite,
    ),
    ("if (abs(a) < 1e9 && abs(b) < 1e9) r.xyz = normalize(vec3(a, b, 0.5));", BITS, Finite),
    (
        "if (abs(a) < 1e4 && abs(b) < 1e4) r.xyz = faceforward(vec3(a, b, 1.0), vec3(1.0, b, a), vec3(0.3, -0.2, a));",
        BITS,
        Finite,
    ),
    ("if (abs(a) < 1e4 && abs(b) < 1e4) r.xyz = reflect(vec3(a, b, 1.0), normalize(vec3(1.0, b, 2.0)));", 1e-5, Finite),
    (
        "if (abs(a) < 1e4) r.xyz = refract(normalize(vec3(a, b, 1.0)), normalize(vec3(0.0, 0.3, -1.0)), 0.7);",
        1e-5,
        Finite,
    ),
    // Section 8.6.
    (
        "if (abs(a) < 1e4 && abs(b) < 1e4) { mat3 m = mat3(2.0, a, 0.0, b, 1.0, 0.5, 0.0, 1.0, 3.0); r.xyz = transpose(m) * vec3(a, 1.0, b); r.w = (matrixCompMult(m, m) * outerProduct(vec3(1.0), vec3(a, b, 2.0)))[1].y; }",
        1e-5,
        Finite,
    ),
    (
        "if (abs(a) < 50.0 && abs(b) < 50.0) { mat3 m = mat3(9.0, a, 0.0, 0.1, 100.0, b, 0.0, 1.0, 90.0); r.xyz = inverse(m) * vec3(1.0, 2.0, 3.0); r.w = determinant(m); }",
        1e-4,
        Finite,
    ),
    (
        "if (abs(a) < 50.0 && abs(b) < 50.0) { mat4 m = mat4(9.0, a, 0.0, 1.0, 0.1, 100.0, b, 0.0, 0.0, 1.0, 90.0, 2.0, 0.0, 0.5, 0.0, 7.0); r = inverse(m) * vec4(1.0, 2.0, 3.0, 4.0); }",
        1e-4,
        Finite,
    ),
    (
        "if (abs(a) < 1e4 && abs(b) < 1e4) { mat2x3 m = mat2x3(a, b, 1.0, 2.0, 3.0, a); r.xy = vec3(1.0, a, b) * m; r.z = (m * vec2(b, a)).z; r.w = (mat3x2(1.0, 2.0, 3.0, 4.0, 5.0, 6.0) * m)[1].x; }",
        1e-5,
        Finite,
    ),
    ("r.xyz = mat3(mat2(a, b, 1.0, 2.0)) * vec3(0.0, 1.0, 1.0); r.w = mat4x2(a)[1].y;", 0.0, Finite),
    // Section 8.14, on the quads of this grid.
    ("r = vec4(dFdx(a), dFdy(a), dFdx(b), dFdy(b));", BITS, Finite),
    (
        "r = vec4(fwidth(a * 0.5 + b), dFdx(a * b * 1e-9), fwidth(float(i)) * 1e-9, dFdy(float(j)) * 1e-9);",
        1e-4,
        Finite,
    ),
    // Integers (sections 5.9 and 8.8), by 16 bits.
    ("int p = i + j; int q = i * j; r = vec4(p & 0xffff, p >> 16, q & 0xffff, q >> 16);", 0.0, All),
    (
        "if (j != 0 && (j != -1 || i != -2147483647 - 1)) { int p = i / j; r.xy = vec2(p & 0xffff, p >> 16); if (i >= 0 && j > 0) r.z = float(i % j); }",
        0.0,
        All,
    ),
    (
        "uint u = uint(i), v = uint(j); if (v != 0u) { uint p = u / v; uint q = u % v; r = vec4(p & 0xffffu, p >> 16, q & 0xffffu, q >> 16); }",
        0.0,
        All,
    ),
    (
        "int p = (i & j) ^ (i | ~j); int q = i << (j & 31); r = vec4(p & 0xffff, p >> 16, q & 0xffff, q >> 16);",
        0.0,
        All,
    ),
    (
        "int p = i >> (j & 31); uint q = uint(i) >> (uint(j) & 31u); r = vec4(p & 0xffff, p >> 16, q & 0xffffu, q >> 16);",
        0.0,
        All,
    ),
    ("r = vec4(i < j, i >= j, uint(i) < uint(j), uint(i) <= uint(j));", 0.0, All),
    (
        "int p = min(i, j) - clamp(i, -5, 9); uint q = max(uint(i), uint(j)); r = vec4(p & 0xffff, p >> 16, q & 0xffffu, q >> 16);",
        0.0,
        All,
    ),
    ("r = vec4(bitCount(i), findLSB(i), findMSB(i), findMSB(uint(j)));", 0.0, All),
    (
        "int p = bitfieldReverse(i); int q = bitfieldExtract(j, 3, 9); r = vec4(p & 0xffff, p >> 16, q & 0xffff, q >> 16);",
        0.0,
        All,
    ),
    (
        "uint q = bitfieldExtract(uint(i), 5, 12); uint c; uint s = uaddCarry(uint(i), uint(j), c); r = vec4(q, c, s & 0xffffu, s >> 16);",
        0.0,
        All,
    ),
    (
        "uint c; uint s = usubBorrow(uint(i), uint(j), c); r = vec4(abs(i) & 0xffff, c, s & 0xffffu, s >> 16); r.x += 0.1 * float(sign(i));",
        0.0,
        All,
    ),
    // Conversions (section 5.4.1).
    (
        "if (abs(a) < 2e9) { int p = int(a); r.xy = vec2(p & 0xffff, p >> 16); } if (a >= 0.0 && a < 4e9) { uint q = uint(a); r.zw = vec2(q & 0xffffu, q >> 16); }",
        0.0,
        All,
    ),
    ("r = vec4(float(i), float(uint(i)), bool(a), bool(i));", BITS, All),
    ("bvec2 t = bvec2(a, i); r.xy = vec2(t); r.zw = vec2(not(t)); r.x += float(t.x ^^ t.y) * 2.0;", 0.0, All),
];

const FLOATS: [f32; TILE as usize] = [
    0.0,
    -0.0,
    0.1,
    -0.1,
    0.25,
    0.5,
    -0.5,
    0.75,
    0.999,
    1.0,
    -1.0,
    1.5,
    -1.5,
    2.0,
    2.5,
    -2.5,
    3.0,
    -3.7,
    7.0,
    10.0,
    -10.0,
    31.5,
    100.3,
    -100.3,
    1e4,
    -1e6,
    1e10,
    -1e10,
    3e38,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];

const INTEGERS: [i32; TILE as usize] = [
    0,
    1,
    -1,
    2,
    -2,
    3,
    5,
    7,
    -8,
    9,
    15,
    16,
    31,
    32,
    33,
    -33,
    63,
    100,
    127,
    128,
    255,
    256,
    -257,
    1000,
    4095,
    65535,
    65536,
    -65537,
    1 << 20,
    1 << 30,
    2_147_483_520,
    i32::MIN,
];

fn source(statement: &str) -> String {
    format!(
        "#version 420\nuniform float floats[{TILE}];\nuniform int integers[{TILE}];\nout vec4 r;\nvoid main() {{\n\
         int x = int(gl_FragCoord.x) % {TILE};\nint y = int(gl_FragCoord.y) % {TILE};\nfloat a = floats[x];\n\
         float b = floats[y];\nint i = integers[x];\nint j = integers[y];\nr = vec4(0.0);\n{statement}\n}}\n"
    )
}

const VERTEX: &str = "#version 420\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";

fn drawn(gl: &Gl, target: &TileTarget, statement: &str) -> Vec<[f32; 4]> {
    let program =
        UserProgram::new(gl, VERTEX, &source(statement)).unwrap_or_else(|error| panic!("{statement}: {error}"));
    let corners = [-1.0, -1.0, 0.0, 3.0, -1.0, 0.0, -1.0, 3.0, 0.0];
    let stream = Stream { name: "position", components: 3, numbers: &corners };
    let mesh = StreamMesh::new(gl, &[stream], &[0, 1, 2], "triangle").unwrap();
    target.begin();
    program.bind();
    program.set("floats", &FLOATS);
    program.set("integers", &INTEGERS.map(|i| i as f32));
    target.select(0);
    mesh.draw(&program, &[(program.attribute_location("position").unwrap(), 0)]);
    target.read(1)
}

fn interpreted(statement: &str) -> Vec<[f32; 4]> {
    let mut parsed = gonio_glsl::parse(&source(statement));
    let checked = gonio_glsl::check(&mut parsed, Stage::Fragment);
    let stage = compile(&parsed, &checked).unwrap_or_else(|error| panic!("{statement}: {error}"));
    let mut inputs = StageInputs::new(&stage, (TILE * TILE) as usize);
    // Four points in a row are a quad.
    let across = |point: u32| point / 4 % (TILE / 2) * 2 + point % 2;
    let up = |point: u32| point / 4 / (TILE / 2) * 2 + point / 2 % 2;
    let x: Vec<f32> = (0..TILE * TILE).map(|point| across(point) as f32 + 0.5).collect();
    let y: Vec<f32> = (0..TILE * TILE).map(|point| up(point) as f32 + 0.5).collect();
    inputs.set_named(&stage, "floats", PointValues::floats(&FLOATS));
    inputs.set_named(&stage, "integers", PointValues::ints(&INTEGERS));
    inputs.set_named(&stage, "gl_FragCoord", PointValues::each(&[&x, &y]));
    let result = run(&stage, &inputs, &RunOptions { quads: true, ..RunOptions::default() });
    let mut pixels = vec![[0.0; 4]; result.points];
    for point in 0..result.points {
        let pixel = (up(point as u32) * TILE + across(point as u32)) as usize;
        pixels[pixel] = std::array::from_fn(|c| result.outputs[0].float(c, point));
    }
    pixels
}

#[test]
fn functions_give_what_the_driver_gives() {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let target = TileTarget::new(context.gl(), TILE, 1).unwrap();
    let mut wrong = Vec::new();
    for (statement, tolerance, arguments) in CASES {
        let (own, driver) = (interpreted(statement), drawn(context.gl(), &target, statement));
        let (mut worst, mut place, mut count) = (0.0, String::new(), 0);
        for (pixel, (own, driver)) in own.iter().zip(&driver).enumerate() {
            let (x, y) = (pixel % TILE as usize, pixel / TILE as usize);
            let is_finite = [FLOATS[x], FLOATS[y]].iter().all(|value| value.abs() < 1e11);
            if *arguments == Finite && !is_finite {
                continue;
            }
            for (component, (a, b)) in own.iter().zip(driver).enumerate() {
                let is_same = a == b || (a.is_nan() && b.is_nan());
                let difference = if is_same { 0.0 } else { (a - b).abs() / b.abs().max(1.0) };
                let difference = if difference.is_nan() { f32::INFINITY } else { difference };
                if difference > *tolerance {
                    count += 1;
                }
                if difference > worst {
                    worst = difference;
                    place = format!(
                        "component {component} of a = {}, b = {}, i = {}, j = {}: {a}, the driver {b}",
                        FLOATS[x], FLOATS[y], INTEGERS[x], INTEGERS[y]
                    );
                }
            }
        }
        if worst > *tolerance {
            wrong.push(format!("{statement}\n    {worst:e} in {count}, {place}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), CASES.len(), wrong.join("\n"));
}
