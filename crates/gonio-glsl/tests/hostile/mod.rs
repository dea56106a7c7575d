//! Generates pairs of shaders that are too large or too deep, or nearly so.

use gonio_glsl::Limit;

/// A pair of shaders, and the limit that the front end must report.
pub struct Pair {
    pub name: &'static str,
    pub vertex: String,
    pub fragment: String,
    /// The limit that it exceeds, if any.
    pub limit: Option<Limit>,
}

const VERTEX: &str = "#version 330 core\nin vec3 position;\nuniform mat4 M, V, P;\n//globals\nvoid main() {\n  \
                      float x = position.x;\n  //body\n  gl_Position = P * V * M * vec4(position, 1.0);\n}\n";
const FRAGMENT: &str = "#version 330 core\nout vec4 colour;\n//globals\nvoid main() {\n  \
                        float x = gl_FragCoord.x;\n  //body\n  colour = vec4(x);\n}\n";

struct Pairs(Vec<Pair>);

impl Pairs {
    /// Adds a pair with this text, alternately in the vertex and in the fragment shader.
    fn add(&mut self, name: &'static str, limit: impl Into<Option<Limit>>, globals: &str, body: &str) {
        let is_vertex = self.0.len().is_multiple_of(2);
        let filled = |text: &str| text.replacen("//globals", globals, 1).replacen("//body", body, 1);
        let (vertex, fragment) = match is_vertex {
            true => (filled(VERTEX), FRAGMENT.to_string()),
            false => (VERTEX.to_string(), filled(FRAGMENT)),
        };
        self.0.push(Pair { name, vertex, fragment, limit: limit.into() });
    }

    fn body(&mut self, name: &'static str, limit: impl Into<Option<Limit>>, body: &str) {
        self.add(name, limit, "", body);
    }
}

/// Concatenates a text for each number.
fn each(count: usize, text: impl Fn(usize) -> String) -> String {
    (0..count).map(text).collect()
}

fn around(open: &str, middle: &str, close: &str, count: usize) -> String {
    format!("{}{middle}{}", open.repeat(count), close.repeat(count))
}

fn doubling(count: usize, first: &str) -> String {
    let more = |i: usize| format!("#define a{} a{i} a{i}\n", i + 1);
    format!("#define a0 {first}\n{}", each(count, more))
}

fn functions(count: usize, first: &str, body: impl Fn(usize) -> String) -> String {
    let more = |i: usize| format!("float f{}(float v) {{ {} }}\n", i + 1, body(i));
    format!("float f0(float v) {{ {first} }}\n{}", each(count, more))
}

/// Generates all pairs.
pub fn pairs() -> Vec<Pair> {
    let mut pairs = Pairs(Vec::new());
    sizes(&mut pairs);
    depths(&mut pairs);
    macros(&mut pairs);
    within(&mut pairs);
    pairs.0
}

fn sizes(pairs: &mut Pairs) {
    use Limit::*;
    for (name, size) in [
        ("array of 2^31 - 1", "2147483647"),
        ("array of 2^32", "4294967296"),
        ("array of more than 64 bits", "99999999999999999999999"),
        ("array of a product", "70000 * 70000"),
        ("array of a shift", "1 << 30"),
        ("array of a hexadecimal number", "0x7fffffff"),
        ("array of an unsigned number", "2147483647u"),
    ] {
        pairs.body(name, Components, &format!("int a[{size}]; a[int(x)] = 1; x = float(a[int(x) + 1]);"));
    }
    pairs.add("array of a constant", Components, "const int N = 1000000;", "float a[N]; a[int(x)] = x;");
    pairs.add("array of a macro", Components, "#define N 1000000", "float a[N]; a[int(x)] = x;");
    pairs.body("array of a power", UnknownSize, "float a[int(pow(2.0, 30.0))]; a[int(x)] = x;");
    pairs.body("array of matrices", Components, "mat4 a[2000]; x = a[int(x)][0][0];");
    pairs.body("array of arrays", Components, "float a[200][200]; x = a[int(x)][0];");
    pairs.body("array of nine dimensions", ArraySizes, &format!("float a{};", "[2]".repeat(9)));
    pairs.add("array of uniforms", Components, "uniform vec4 u[1000000];", "x = u[int(x)].x;");
    pairs.add("unused array", Components, "float unused[2147483647];", "");
    pairs.add("inputs or outputs in an array", InterfaceComponents, "out float v[5000];", "v[int(x)] = x;");
    let list = each(20_000, |i| format!("{}{i}.5", if i == 0 { "" } else { "," }));
    pairs.add("constant array", Components, &format!("const float t[] = float[]({list});"), "x = t[int(x)];");
    pairs.body("array constructor", Components, "x = float[100000](x)[0];");
    let structs = each(6, |i| format!("struct S{} {{ S{i} a[16]; }};\n", i + 1));
    pairs.add("structs of arrays of structs", Components, &format!("struct S0 {{ float a; }};\n{structs}"), "S6 s;");
    pairs.body("many arrays", AllComponents, &each(10, |i| format!("float a{i}[10000]; ")));
    pairs.add("many functions", Functions, &functions(10_000, "return v;", |_| "return v;".into()), "x = f1(x);");
    let overloads = each(200, |i| format!("float f(float a[{}]) {{ return 1.0; }}\n", i + 1));
    pairs.add("many functions of one name", Functions, &overloads, "");
    let names = each(10_000, |i| format!("{}u{i}", if i == 0 { "" } else { ", " }));
    pairs.add("many uniforms", Variables, &format!("uniform float {names};"), "");
    pairs.add("a struct of many members", Variables, &format!("struct S {{ float {names}; }};"), "");
    pairs.body("many tokens", Tokens, &"x += 0.5; ".repeat(100_000));
    pairs.body("very many tokens", Tokens, &"x += 0.5; ".repeat(300_000));
    pairs.body("many bytes", Bytes, &format!("// {}", "-".repeat(5_000_000)));
    pairs.body("a long name", Name, &format!("float {} = x;", "a".repeat(100_000)));
    let cases = each(2000, |i| format!("case {i}: x = {i}.0; break; "));
    pairs.body("a switch of many cases", Cases, &format!("switch (int(x)) {{ {cases} }}"));
    pairs.body("many errors and a giant array", Components, &format!("{} int a[2147483647];", "x = ; ".repeat(100)));
    pairs.body("many errors", SyntaxErrors, &"x = ;\n".repeat(100));
    pairs.body("an array outside a statement", Components, "? ] int a[2147483647]; (");
}

fn depths(pairs: &mut Pairs) {
    use Limit::*;
    let long = 5000;
    pairs.body("a long sum", Nested, &format!("x = x{};", " + 0.0".repeat(long)));
    pairs.body("parentheses", Nested, &format!("x = {};", around("(", "x", ")", long)));
    pairs.body("parentheses that are never closed", Nested, &"(".repeat(100_000));
    pairs.body("calls within calls", Nested, &format!("x = {};", around("sin(", "x", ")", long)));
    pairs.body("unary minus", Nested, &format!("x = {}x;", "- ".repeat(long)));
    pairs.body("negations", Nested, &format!("bool b = {}true;", "!".repeat(long)));
    pairs.body("braces", Nested, &around("{", "x = 1.0;", "}", long));
    pairs.body("ifs", Nested, &format!("{} x = 1.0;", "if (x > 1.0) ".repeat(long)));
    pairs.body("else ifs", Nested, &format!("{} ;", each(long, |i| format!("if (x == {i}.5) x = 1.0; else "))));
    pairs.body("conditions within conditions", Nested, &format!("x = {} 1.0;", "x > 1.0 ? 2.0 : ".repeat(long)));
    pairs.body("swizzles of swizzles", Nested, &format!("vec4 v = vec4(x); v = v{};", ".xyzw".repeat(long)));
    pairs.body("assignments of assignments", Nested, &format!("{} 1.0;", "x = ".repeat(long)));
    pairs.body("indices of indices", Nested, &format!("int a[3]; x = float({});", around("a[", "0", "]", long)));
    let nested = around("struct A { ", "int a;", "};", 300);
    pairs.add("structs in structs", Nested, &nested, "");
    let structs = each(100, |i| format!("struct S{} {{ S{i} a; }};\n", i + 1));
    pairs.add("structs of structs", StructsNested, &format!("struct S0 {{ float a; }};\n{structs}"), "");
    let loops = each(60, |i| format!("for (int i{i} = 0; i{i} < int(x); i{i}++) "));
    pairs.body("loops", LoopsNested, &format!("{loops} x += 1.0;"));
    let looping = |i: usize| format!("for (int i = 0; i < int(v); i++) v += f{i}(v); return v;");
    pairs.add("loops through calls", LoopsNested, &functions(20, "return v;", looping), "x = f20(x);");
    let calling = |i: usize| format!("return f{i}(v) + 1.0;");
    pairs.add("functions that call functions", CallsNested, &functions(4000, "return v;", calling), "x = f4000(x);");
    let twice = |i: usize| format!("return f{i}(v) + f{i}(v + 1.0);");
    pairs.add("calls that double", Inlined, &functions(40, "return v * v;", twice), "x = f40(x);");
    pairs.add("#if within #if", None, "", &format!("\n{}{}", "#if 1\n".repeat(50_000), "#endif\n".repeat(50_000)));
    let condition = around("(", "1", ")", 200);
    pairs.body("parentheses in a condition", Nested, &format!("\n#if {condition}\n#endif\n"));
    let signs = "!".repeat(5000);
    pairs.body("signs in a condition", Nested, &format!("\n#if {signs}1\n#endif\n"));
}

fn macros(pairs: &mut Pairs) {
    use Limit::*;
    pairs.add("macros that double", Macros, &doubling(40, "x += 0.5;"), "a40");
    pairs.add("macros that double in a condition", Macros, &doubling(40, "+ 1"), "\n#if 1 a40\n#endif\n");
    pairs.add("macros of macros", Macros, &each(5000, |i| format!("#define m{} m{i}\n", i + 1)), "x = m5000;");
    let nested = around("f(", "x", ")", 200);
    pairs.add("macros in arguments of macros", Macros, "#define f(v) v", &format!("x = {nested};"));
    let nested = around("f(", "x", ")", 2000);
    pairs.add("macros in unused arguments", Nested, "#define f(v) 1.0", &format!("x = {nested};"));
    let endless = "#define f(v) f(v) g(v)\n#define g(v) f(v f(v))\n#define A A B\n#define B A A\n";
    pairs.add("recursive macros", None, endless, "x = 1.0;");
    let pasting = each(40, |i| format!("#define p{}(v) p{i}(v##v)\n", i + 1));
    pairs.add("names that double", Name, &format!("#define p0(v) v\n{pasting}"), "float p40(ab) = x;");
}

/// Large and deep shaders within all limits.
fn within(pairs: &mut Pairs) {
    pairs.body("a sum of 240 terms", None, &format!("x = x{};", " + 0.5".repeat(240)));
    pairs.body("240 parentheses", None, &format!("x = {};", around("(", "x", ")", 240)));
    pairs.body("240 calls within calls", None, &format!("x = {};", around("sin(", "x", ")", 240)));
    pairs.body("240 unary minus", None, &format!("x = {}x;", "- ".repeat(240)));
    pairs.body("240 braces", None, &around("{", "x = 1.0;", "}", 240));
    pairs.body("240 else ifs", None, &format!("{} ;", each(240, |i| format!("if (x == {i}.5) x = 1.0; else "))));
    pairs.body("240 conditions within conditions", None, &format!("x = {} 1.0;", "x > 1.0 ? 2.0 : ".repeat(240)));
    pairs.body("240 swizzles", None, &format!("vec4 v = vec4(x); v = v{};", ".xyzw".repeat(240)));
    pairs.body(
        "10 loops",
        None,
        &format!("{} x += 1.0;", each(10, |i| format!("for (int i{i} = 0; i{i} < int(x); i{i}++) "))),
    );
    pairs.body("4,000 lines", None, &"x = mix(x, 2.0 * x + 1.0, 0.5);\n".repeat(4000));
    let list = each(16_384, |i| format!("{}{i}.5", if i == 0 { "" } else { "," }));
    pairs.add("64 KiB of constants", None, &format!("const float t[] = float[]({list});"), "x = t[int(x)];");
    pairs.add("64 KiB of uniforms", None, "uniform vec4 u[4096];", "x = u[int(x)].x;");
    let calling = |i: usize| format!("return f{i}(v) + 1.0;");
    pairs.add("200 functions that call each other", None, &functions(200, "return v;", calling), "x = f200(x);");
    pairs.add("a built-in constant as size", None, "", "vec4 a[gl_MaxDrawBuffers]; a[0] = vec4(x);");
    pairs.add("1,024 statements by macros", None, &doubling(10, "x += 0.5;"), "a10");
}
