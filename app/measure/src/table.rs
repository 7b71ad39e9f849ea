//! Results as a table on the terminal, and as a file of comma-separated values for programs.

use std::fmt::Write as _;
use std::path::Path;

use super::row::Row;

/// Columns of the file. Each dial fills the columns that apply to it; the others stay empty.
const COLUMNS: [&str; 24] = [
    "ms_median",
    "ms_95",
    "bend_ms_median",
    "bend_ms_95",
    "upload_ms_median",
    "upload_ms_95",
    "draw_ms_median",
    "draw_ms_95",
    "ns",
    "bytes",
    "arcmin_median",
    "arcmin_99",
    "arcmin_most",
    "share_above_1_arcmin",
    "delta_e_median",
    "delta_e_99",
    "delta_e_most",
    "flip",
    "position_m",
    "rapidity",
    "direction_rad_median",
    "direction_rad_99",
    "direction_rad_most",
    "pareto",
];

/// Setting of a dial, and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Name of the dial.
    pub dial: &'static str,
    /// Value of the setting, in the form of the command line if there is one.
    pub setting: String,
    /// Numbers with their names, which are among `COLUMNS`.
    pub numbers: Vec<(&'static str, f64)>,
}

impl From<&Row> for Line {
    fn from(row: &Row) -> Self {
        let names = [("ms_median", "ms_95"), ("bend_ms_median", "bend_ms_95"), ("upload_ms_median", "upload_ms_95")];
        let pairs = names.into_iter().chain([("draw_ms_median", "draw_ms_95")]);
        let times = pairs.zip([row.ms].into_iter().chain(row.stages_ms));
        let mut numbers: Vec<(&'static str, f64)> =
            times.flat_map(|((median, slow), [ms, most])| [(median, ms), (slow, most)]).collect();
        numbers.extend(row.bytes.map(|bytes| ("bytes", bytes)));
        numbers.extend(["arcmin_median", "arcmin_99", "arcmin_most"].into_iter().zip(row.arcmin));
        numbers.push(("share_above_1_arcmin", row.above_one));
        if let Some((delta_e, flip)) = row.colour {
            numbers.extend(["delta_e_median", "delta_e_99", "delta_e_most"].into_iter().zip(delta_e));
            numbers.push(("flip", flip));
        }
        numbers.push(("pareto", f64::from(u8::from(row.best))));
        let dial = row.dial.turned().map_or("renderer", |(name, _)| name);
        Self { dial, setting: row.dial.to_string(), numbers }
    }
}

/// Table of the renderers' dials as Markdown, which is also readable on a terminal.
pub fn of_pictures(rows: &[Row]) -> String {
    let coloured = rows.iter().any(|row| row.colour.is_some());
    let mut columns =
        vec!["   ", "setting", "ms", "95 %", "bend", "upload", "draw", "MB", "arcmin", "99 %", "most", "above 1′"];
    if coloured {
        columns.extend(["ΔE2000", "99 %", "most", "FLIP"]);
    }
    let mut table = Markdown::new(&columns);
    for row in rows {
        let [bend, upload, draw] = row.stages_ms.map(|[median, _]| median);
        let mut cells = vec![if row.best { "*" } else { " " }.to_owned(), row.dial.to_string()];
        cells.extend([row.ms[0], row.ms[1], bend, upload, draw].map(|ms| format!("{ms:.1}")));
        cells.push(row.bytes.map_or_else(|| "?".to_owned(), |bytes| format!("{:.0}", bytes / 1e6)));
        cells.extend(row.arcmin.map(|arcmin| format!("{arcmin:.3}")));
        cells.push(format!("{:.1} %", 100.0 * row.above_one));
        if let Some((delta_e, flip)) = row.colour {
            cells.extend(delta_e.map(|delta_e| format!("{delta_e:.2}")));
            cells.push(format!("{flip:.4}"));
        }
        table.add(cells);
    }
    table.text() + "* no other is both faster and closer by the 99th percentile\n"
}

/// Markdown table that grows row by row.
pub struct Markdown(Vec<Vec<String>>);

impl Markdown {
    /// Table with these headings. The first two columns are of words, the others of numbers.
    pub fn new(columns: &[&str]) -> Self {
        Self(vec![columns.iter().map(|heading| (*heading).to_owned()).collect()])
    }

    /// Adds a row.
    pub fn add(&mut self, cells: Vec<String>) {
        self.0.push(cells);
    }

    /// Text of the table, with aligned columns.
    pub fn text(&self) -> String {
        let columns = self.0[0].len();
        let length = |cell: &String| cell.chars().count();
        let widths: Vec<usize> = (0..columns)
            .map(|column| self.0.iter().filter_map(|row| row.get(column)).map(length).max().unwrap_or(0))
            .collect();
        let mut text = String::new();
        for (number, row) in self.0.iter().enumerate() {
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let room = " ".repeat(width - length(cell));
                let cell = if column < 2 { format!("{cell}{room}") } else { format!("{room}{cell}") };
                let _ = write!(text, "| {cell} ");
            }
            text += "|\n";
            if number == 0 {
                let lines = widths.iter().enumerate().map(|(column, width)| {
                    let line = "-".repeat(width + 1);
                    if column < 2 { format!("|-{line}") } else { format!("|{line}:") }
                });
                text += &lines.collect::<String>();
                text += "|\n";
            }
        }
        text
    }
}

/// Writes all lines into one file.
///
/// # Errors
/// A file that cannot be written.
pub fn write_csv(lines: &[Line], path: &Path) -> std::io::Result<()> {
    std::fs::write(path, csv(lines))
}

fn csv(lines: &[Line]) -> String {
    let mut text = format!("dial,setting,{}\n", COLUMNS.join(","));
    for Line { dial, setting, numbers } in lines {
        debug_assert!(numbers.iter().all(|(name, _)| COLUMNS.contains(name)), "{numbers:?}");
        let cell = |column: &&str| {
            let number = numbers.iter().find(|(name, _)| name == column);
            number.map_or_else(String::new, |(_, value)| value.to_string())
        };
        let cells: Vec<String> = COLUMNS.iter().map(cell).collect();
        let _ = writeln!(text, "{dial},{setting},{}", cells.join(","));
    }
    text
}

#[cfg(test)]
mod tests {
    //! Every number must stand below its name, whatever numbers a line has.

    use super::*;

    #[test]
    fn numbers_stand_below_their_names() {
        let line =
            |dial, numbers: &[(&'static str, f64)]| Line { dial, setting: "1".to_owned(), numbers: numbers.to_vec() };
        let text = csv(&[line("step", &[("rapidity", 0.5), ("ns", 3.0)]), line("edge", &[("ms_median", 7.25)])]);
        let rows: Vec<Vec<&str>> = text.lines().map(|row| row.split(',').collect()).collect();
        assert!(rows.iter().all(|row| row.len() == 2 + COLUMNS.len()));
        let at = |row: usize, name: &str| rows[row][rows[0].iter().position(|column| *column == name).unwrap()];
        assert_eq!((at(1, "dial"), at(1, "rapidity"), at(1, "ns"), at(1, "ms_median")), ("step", "0.5", "3", ""));
        assert_eq!((at(2, "setting"), at(2, "ms_median"), at(2, "ns")), ("1", "7.25", ""));
    }

    #[test]
    fn columns_stand_below_each_other() {
        let mut table = Markdown::new(&["a", "b", "c"]);
        table.add(["x", "long′", "1.25"].map(str::to_owned).to_vec());
        let text = table.text();
        let ends = |line: &str| {
            line.char_indices()
                .filter(|(_, sign)| *sign == '|')
                .map(|(at, _)| line[..at].chars().count())
                .collect::<Vec<_>>()
        };
        let lines: Vec<_> = text.lines().map(ends).collect();
        assert!(lines.windows(2).all(|pair| pair[0] == pair[1]), "{text}");
    }
}
