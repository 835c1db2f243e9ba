// Files that the page gives: tables as CSV, pictures as PNG.

type Cell = string | number | null | undefined;

/** Numbers are written so that they read back exactly; an empty field is not a number. */
export function csv(head: string[], rows: Cell[][]): string {
  const field = (cell: Cell) => {
    const text = cell === null || cell === undefined || (typeof cell === "number" && !Number.isFinite(cell)) ? "" : String(cell);
    return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return [head, ...rows].map((row) => row.map(field).join(",")).join("\n") + "\n";
}

export function saveCsv(name: string, head: string[], rows: Cell[][]): void {
  save(`${name}.csv`, new Blob([csv(head, rows)], { type: "text/csv" }));
}

export function savePng(name: string, canvas: HTMLCanvasElement): void {
  canvas.toBlob((blob) => blob && save(`${name}.png`, blob), "image/png");
}

function save(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** `model` of `model.results`, and what the file shows. */
export function fileName(directory: string, ...parts: (string | number)[]): string {
  return [directory.replace(/\.results$/, ""), ...parts].join("_").replace(/[^\p{L}\p{N}_.-]+/gu, "_");
}
