// Mouse, touch and keyboard on the picture.
import type { Camera } from "./camera";

export interface Actions {
  changed(): void; // the camera
  pick(px: number, py: number): void;
  line(from: [number, number], to: [number, number]): void; // pixels; drawn with the Shift key, or where `drawsLine` says so
  drawsLine(): boolean;
  hover(px: number, py: number): void;
  leave(): void;
  step(by: number): void; // increments
  play(): void;
  clear(): void;
}

const PAN = 60, CLICK = 5; // pixels

/** `stage` receives mouse and touch, because the canvas in it may be moved for a moment; the canvas has the keyboard. */
export function interact(stage: HTMLElement, canvas: HTMLCanvasElement, camera: Camera, actions: Actions): void {
  const pointers = new Map<number, [number, number]>();
  let moved = 0, start: [number, number] | null = null; // of a line
  const at = (event: PointerEvent | WheelEvent): [number, number] => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop];
  };
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
    event.preventDefault();
    pointers.set(event.pointerId, at(event));
    moved = 0;
    start = pointers.size === 1 && (event.shiftKey || actions.drawsLine()) ? at(event) : null;
  });
  stage.addEventListener("pointermove", (event) => {
    const now = at(event), before = pointers.get(event.pointerId);
    if (!before) return actions.hover(...now);
    if (start) {
      moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
      pointers.set(event.pointerId, now);
      if (moved >= CLICK) actions.line(start, now);
      return;
    }
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)![1];
      const distance = (point: [number, number]) => Math.hypot(point[0] - other[0], point[1] - other[1]);
      camera.zoom(distance(now) / Math.max(distance(before), 1), 0.5 * (now[0] + other[0]), 0.5 * (now[1] + other[1]));
    } else {
      camera.pan(now[0] - before[0], now[1] - before[1]);
    }
    moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    pointers.set(event.pointerId, now);
    actions.changed();
  });
  const end = (event: PointerEvent) => {
    if (pointers.delete(event.pointerId) && event.type === "pointerup" && moved < CLICK && pointers.size === 0) actions.pick(...at(event));
  };
  stage.addEventListener("pointerup", end);
  stage.addEventListener("pointercancel", end);
  stage.addEventListener("pointerleave", () => actions.leave());
  stage.addEventListener("dblclick", (event) => {
    event.preventDefault();
    camera.reset();
    actions.changed();
  });
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaMode === 2 ? 400 * event.deltaY : event.deltaY;
    camera.zoom(Math.exp(-0.0016 * Math.max(-300, Math.min(300, pixels))), ...at(event));
    actions.changed();
  }, { passive: false });

  const keys: Record<string, () => void> = {
    ArrowLeft: () => camera.pan(PAN, 0), ArrowRight: () => camera.pan(-PAN, 0), ArrowUp: () => camera.pan(0, PAN), ArrowDown: () => camera.pan(0, -PAN),
    "+": () => camera.zoom(1.25), "=": () => camera.zoom(1.25), "-": () => camera.zoom(0.8), "0": () => camera.reset(), Home: () => camera.reset(),
    Enter: () => actions.pick(0.5 * camera.width, 0.5 * camera.height), PageUp: () => actions.step(-1), PageDown: () => actions.step(1),
    " ": () => actions.play(), Escape: () => actions.clear(),
  };
  canvas.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    act();
    actions.changed();
  });
}
