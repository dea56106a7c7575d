// Sorts the submissions by any column, and shows those that a filter fits. The table is complete without it.
(() => {
    const table = document.querySelector(".all table");
    const body = table.tBodies[0];
    const heads = [...table.tHead.rows[0].cells];
    const rows = [...body.rows];
    const filter = document.getElementById("filter");
    const status = document.querySelector(".filter [role=status]");

    // Letters without case and accents: `zoe` finds Zoé.
    const plain = (text) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
    const texts = new Map(rows.map((row) => [row, plain(row.textContent)]));

    const key = (row, column) => Number(row.cells[column].dataset.key);
    const sort = (column) => {
        const isUp = heads[column].getAttribute("aria-sort") !== "ascending";
        heads.forEach((head, other) =>
            head.setAttribute("aria-sort", other !== column ? "none" : isUp ? "ascending" : "descending"));
        // `rows` stays in the order of names, which decides between equal keys.
        const sorted = [...rows].sort((a, b) => (key(a, column) - key(b, column)) * (isUp ? 1 : -1));
        body.append(...sorted);
    };
    heads.forEach((head, column) => {
        const button = document.createElement("button");
        button.type = "button";
        button.append(...head.childNodes);
        button.addEventListener("click", () => sort(column));
        head.append(button);
    });

    const show = () => {
        const words = plain(filter.value).split(/\s+/);
        rows.forEach((row) => { row.hidden = !words.every((word) => texts.get(row).includes(word)); });
        const count = rows.filter((row) => !row.hidden).length;
        const shown = status.dataset.shown.replace("$count", count).replace("$all", rows.length);
        status.textContent = filter.value.trim() ? shown : "";
    };
    filter.addEventListener("input", show);
    // Browsers keep the text of a field when a page is loaded again.
    show();
    filter.parentElement.hidden = false;
    table.classList.add("sortable");

    // A link to a hidden row shows all rows.
    addEventListener("hashchange", () => {
        const target = document.getElementById(location.hash.slice(1));
        if (target?.hidden) {
            filter.value = "";
            show();
            target.scrollIntoView();
        }
    });
})();
