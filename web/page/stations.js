// Computes the stations beyond the rendering equation, in a worker of their own (`tracer.js`). The work is cut into steps, and
// between two of them a newer request is taken.

import * as module from "./gonio_trace.js";

let stations;
/** The newest request until work on it begins: `{ number, text }`, or null to pause. */
let wanted;
let working = false;
/** Lets messages arrive. */
let turn;

const clock = () => performance.now();
const fail = (error) => self.postMessage({ failed: typeof error === "string" ? error : String(error?.message ?? error) });

/** Posts the list of stations once the module is `loaded`. Requests wait for that. `pause` lets messages arrive. */
export async function openStations(loaded, pause) {
  turn = pause;
  try {
    await loaded;
    stations = new module.PageStations();
    self.postMessage({ stations: stations.list() });
  } catch (error) {
    fail(error);
    return;
  }
  if (wanted) work();
}

/** Computes this in place of what was requested before; null pauses the work. */
export function requestStation(request) {
  wanted = request;
  if (request !== null && stations !== undefined && !working) work();
}

/** Computes the newest request, until it is finished or paused. One that is not presentable yet is not interrupted: otherwise
 * nothing would be seen while a slider moves. */
async function work() {
  working = true;
  try {
    while (wanted) {
      const { number, text } = wanted;
      wanted = undefined;
      stations.begin(text, clock());
      while (wanted === undefined || !stations.is_presentable()) {
        const { left, ...result } = stations.advance(clock);
        if (Object.keys(result).length > 0) self.postMessage({ number, ...result }, result.rgb ? [result.rgb.buffer] : []);
        if (!left) {
          self.postMessage({ number });
          break;
        }
        await turn();
      }
    }
  } catch (error) {
    fail(error);
  }
  working = false;
}
