// The module in two (web/split): whatever is called, before or after the second half came, is what the whole one does.

import assert from "node:assert/strict";
import binaryen from "binaryen";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, extname, join } from "node:path";
import { test } from "node:test";

/** Built together with the program. */
const SPLIT = join(dirname(process.env.GONIO_PROGRAM ?? ""), `gonio-web-split${extname(process.env.GONIO_PROGRAM ?? "")}`);

/** Its own functions, in the order of the file: those that stay, then those that are moved. */
const TEXT = `(module
  (import "page" "note" (func $note (param i32)))
  (import "page" "double" (func $double (param i32) (result i32)))
  (memory (export "memory") 1)
  (data (i32.const 16) "\\2a\\00\\00\\00")
  (global $count (mut i32) (i32.const 100))
  (table (export "table") 4 4 funcref)
  (elem (i32.const 1) $add_one $square $wide)
  (type $one (func (param i32) (result i32)))

  (func $add_one (param i32) (result i32) (i32.add (local.get 0) (i32.const 1)))
  (func $direct (export "direct") (param i32) (result i32)
    (call $note (i32.const 1))
    (if (result i32) (i32.gt_s (local.get 0) (i32.const 0))
      (then (i32.add (call $cube (local.get 0)) (call $square (local.get 0))))
      (else (i32.const -1))))
  (func $indirect (export "indirect") (param i32 i32) (result i32)
    (call_indirect (type $one) (local.get 1) (local.get 0)))
  (func $tail (export "tail") (param i32) (result i32)
    (if (result i32) (local.get 0) (then (return_call $back (local.get 0))) (else (i32.const 77))))
  (func $many (export "many") (result f64)
    (call $wide (i32.const 1) (i64.const 2) (f32.const 3) (f64.const 4) (i32.const 5) (i64.const 6) (f32.const 7) (f64.const 8)))
  (func $two (export "two") (param i32) (result i32) (local i32)
    (call $split (local.get 0))
    (local.set 1)
    (i32.sub (local.get 1)))
  (func $counted (export "counted") (result i32) (global.get $count))

  (func $square (param i32) (result i32)
    (call $note (i32.const 2))
    (i32.mul (local.get 0) (local.get 0)))
  (func $cube (param i32) (result i32)
    (i32.mul (call $hidden (local.get 0)) (call $add_one (i32.sub (local.get 0) (i32.const 1)))))
  (func $hidden (param i32) (result i32)
    (call $note (i32.const 3))
    (i32.mul (local.get 0) (local.get 0)))
  (func $wide (param i32 i64 f32 f64 i32 i64 f32 f64) (result f64)
    (f64.add (f64.add (f64.add (f64.convert_i32_s (local.get 0)) (f64.mul (f64.const 10) (f64.convert_i64_s (local.get 1))))
                      (f64.add (f64.mul (f64.const 100) (f64.promote_f32 (local.get 2))) (f64.mul (f64.const 1e3) (local.get 3))))
             (f64.add (f64.add (f64.mul (f64.const 1e4) (f64.convert_i32_s (local.get 4))) (f64.mul (f64.const 1e5) (f64.convert_i64_s (local.get 5))))
                      (f64.add (f64.mul (f64.const 1e6) (f64.promote_f32 (local.get 6))) (f64.mul (f64.const 1e7) (local.get 7))))))
  (func $split (param i32) (result i32 i32)
    (i32.shr_s (local.get 0) (i32.const 4))
    (i32.and (local.get 0) (i32.const 15)))
  (func $state (export "state") (param i32) (result i32)
    (global.set $count (i32.add (global.get $count) (local.get 0)))
    (i32.store (i32.const 20) (i32.load (i32.const 16)))
    (call $double (i32.load (i32.const 20))))
  (func $back (param i32) (result i32) (return_call $tail (i32.sub (local.get 0) (i32.const 1))))
)`;
/** Of the functions above. */
const STAY = 7;
const MOVED = 7;

/** What is asked of a module, each in a module of its own, and of one after the other. */
const QUESTIONS = {
  "a direct call": (it) => it.exports.direct(3),
  "the branch that calls nothing": (it) => it.exports.direct(0),
  "a call through the table": (it) => it.exports.indirect(2, 7),
  "a call through the table of one that stays": (it) => it.exports.indirect(1, 7),
  // Each of them with a frame of its own would be too many.
  "calls in the place of returns": (it) => it.exports.tail(300_000),
  "parameters of all kinds": (it) => it.exports.many(),
  "two results": (it) => it.exports.two(0x57),
  "an export that was moved, memory, a global and an import": (it) => [it.exports.state(5), it.exports.counted(), new Uint32Array(it.exports.memory.buffer)[5]],
  "a function taken from the table": (it) => it.exports.table.get(2)(9),
};

const folder = mkdtempSync(join(tmpdir(), "gonio-split-"));
process.on("exit", () => rmSync(folder, { recursive: true }));
const file = (name) => join(folder, name);

function whole() {
  const module = binaryen.parseText(TEXT);
  const { MutableGlobals, ReferenceTypes, Multivalue, TailCall } = binaryen.Features;
  module.setFeatures(MutableGlobals | ReferenceTypes | Multivalue | TailCall);
  const bytes = module.emitBinary();
  module.dispose();
  return bytes;
}

/** Both halves, as `ran` says. */
function halves(ran) {
  writeFileSync(file("whole.wasm"), whole());
  writeFileSync(file("ran.txt"), `${ran}\n`);
  execFileSync(SPLIT, ["split", ...["whole.wasm", "ran.txt", "primary.wasm", "rest.wasm"].map(file)], { stdio: "pipe" });
  return ["primary.wasm", "rest.wasm"].map((name) => new WebAssembly.Module(readFileSync(file(name))));
}

/** An instance of the whole module. Its `notes` are what it calls. */
function instance(module, more = {}) {
  const notes = [];
  const page = { note: (n) => notes.push(n), double: (n) => 2 * n };
  return { notes, exports: new WebAssembly.Instance(module, { page, ...more }).exports };
}

/** An instance of the first half, that loads the second when it is asked to. `loads`: how often it was. */
function firstHalf([primary, rest]) {
  const it = { loads: 0 };
  const load = () => {
    it.loads++;
    new WebAssembly.Instance(rest, { primary: it.exports });
  };
  return Object.assign(it, instance(primary, { rest: { load } }), { load });
}

const SPLIT_AS_ABOVE = "1".repeat(STAY) + "0".repeat(MOVED);

for (const [what, ask] of Object.entries(QUESTIONS)) {
  test(`a module in two: ${what}`, () => {
    const before = instance(new WebAssembly.Module(whole()));
    const modules = halves(SPLIT_AS_ABOVE);
    const late = firstHalf(modules);
    const early = firstHalf(modules);
    early.load();
    // Twice: with the stub in its place, and with the function.
    for (const time of ["once", "again"]) {
      const wanted = ask(before);
      assert.deepEqual(ask(late), wanted, `loaded when needed, ${time}`);
      assert.deepEqual(ask(early), wanted, `loaded before, ${time}`);
    }
    assert.deepEqual(late.notes, before.notes);
    assert.deepEqual(early.notes, before.notes);
    assert.equal(early.loads, 1, "a stub was still in its place");
    const needsNone = ["the branch that calls nothing", "a call through the table of one that stays"];
    assert.equal(late.loads, needsNone.includes(what) ? 0 : 1);
  });
}

test("a module in two does the same whichever function is moved", () => {
  const before = instance(new WebAssembly.Module(whole()));
  const wanted = Object.values(QUESTIONS).map((ask) => ask(before));
  for (let moved = 0; moved < STAY + MOVED; moved++) {
    const ran = Array.from({ length: STAY + MOVED }, (_, n) => (n === moved ? 0 : 1)).join("");
    const it = firstHalf(halves(ran));
    assert.deepEqual(Object.values(QUESTIONS).map((ask) => ask(it)), wanted, `function ${moved} moved`);
    assert.deepEqual(it.notes, before.notes);
  }
});

test("a module in two: moved functions are in the second half and nowhere else", () => {
  const [primary, rest] = halves(SPLIT_AS_ABOVE);
  // What only moved functions call is handed on; the memory, the table and the global are one for both.
  const kinds = WebAssembly.Module.imports(rest).map(({ module, kind }) => `${module} ${kind}`).sort();
  assert.deepEqual(kinds, ["primary function", "primary function", "primary function", "primary function", "primary global", "primary memory", "primary table"]);
  assert.deepEqual(WebAssembly.Module.exports(rest), []);
  assert.deepEqual(WebAssembly.Module.customSections(primary, "name"), []);
  // The constant of `$wide` that no other function has.
  const tenMillion = Buffer.from(new Float64Array([1e7]).buffer);
  assert.ok(!readFileSync(file("primary.wasm")).includes(tenMillion));
  assert.ok(readFileSync(file("rest.wasm")).includes(tenMillion));
});

test("a second half that does not come is an error where it was needed, and is asked for again", () => {
  const modules = halves(SPLIT_AS_ABOVE);
  let fails = true;
  const it = instance(modules[0], {
    rest: {
      load: () => {
        if (fails) throw new Error("no connection");
        new WebAssembly.Instance(modules[1], { primary: it.exports });
      },
    },
  });
  assert.throws(() => it.exports.direct(3), /no connection/);
  assert.throws(() => it.exports.state(3), /no connection/);
  fails = false;
  assert.equal(it.exports.direct(3), 36);
});

test("the module that is visited notes which functions ran", () => {
  writeFileSync(file("whole.wasm"), whole());
  execFileSync(SPLIT, ["instrument", file("whole.wasm"), file("noting.wasm")], { stdio: "pipe" });
  const it = instance(new WebAssembly.Module(readFileSync(file("noting.wasm"))));
  const count = it.exports["ran:functions"].value;
  assert.equal(count, STAY + MOVED);
  const ran = () => Array.from({ length: count }, (_, n) => (it.exports[`ran:${n >> 5}`].value >> (n & 31)) & 1).join("");
  assert.equal(ran(), "0".repeat(count));
  it.exports.counted();
  assert.equal(ran(), "00000010000000");
  assert.equal(it.exports.direct(3), 36);
  assert.equal(ran(), "11000011110000");
});

test("a profile of another module is refused", () => {
  assert.throws(() => halves("101"), /3 characters.*14 functions/);
  assert.throws(() => halves("2".repeat(STAY + MOVED)), /0 or 1/);
});
