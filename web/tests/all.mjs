// Every test of the page, in one process: they share a browser. `cargo xtask test --web` runs this, and so does `--all`.

import "./continuous.mjs";
import "./truth.test.mjs";
import "./compare.test.mjs";
import "./samples.test.mjs";
import "./bench.test.mjs";
import "./bake.test.mjs";
import "./stations.test.mjs";
import "./environment.test.mjs";
import "./again.test.mjs";
