// Every test of the page, in one process: they share a browser. `cargo xtask test --web` runs this.

import "./opening.test.mjs";
import "./first.test.mjs";
import "./lab.test.mjs";
import "./equation.test.mjs";
import "./lights.test.mjs";
import "./probe.test.mjs";
import "./compare.test.mjs";
import "./truth.test.mjs";
import "./keys.test.mjs";
import "./access.test.mjs";
import "./frame.test.mjs";
import "./files.test.mjs";
import "./samples.test.mjs";
import "./link.test.mjs";
import "./phone.test.mjs";
import "./parity.test.mjs";
import "./check.test.mjs";
import "./exercise.test.mjs";
import "./french.test.mjs";
import "./scripts.test.mjs";
import "./bench.test.mjs";
import "./bake.test.mjs";
import "./stations.test.mjs";
import "./environment.test.mjs";
import "./trouble.test.mjs";
import "./again.test.mjs";
