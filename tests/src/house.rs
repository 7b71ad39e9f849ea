//! The house as its files say it: crates, files, imports, names and comments, read from the sources alone.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};
use syn::{Attribute, File, Item, ItemMod, ItemUse, UseTree, Visibility};

/// Words with which no doc comment opens: a doc comment names a thing or an action.
const OPENERS: [&str; 7] = ["What", "Who", "Whether", "Of", "As", "How", "Where"];
/// Largest width of a comment line, columns.
pub const WIDTH: usize = 120;

/// Functions of the C library whose last bits differ between processors and versions.
const ELEMENTARY: [&str; 25] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
    "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "cbrt", "hypot",
];

/// One source file of a crate, tests excluded.
pub struct SourceFile {
    /// Path below the root of the house.
    pub path: PathBuf,
    /// Path of its module in the crate, without `crate`.
    module: Vec<String>,
    text: String,
    items: File,
}

/// A crate's folder, with its sources.
pub struct Room {
    /// Name of the package.
    pub name: String,
    /// Sources below `src`.
    pub files: Vec<SourceFile>,
}

/// Calls of functions whose last bits differ between processors.
struct ElementaryCalls(Vec<String>);

impl<'ast> Visit<'ast> for ElementaryCalls {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        if ELEMENTARY.contains(&call.method.to_string().as_str()) {
            self.0.push(call.method.to_string());
        }
        visit::visit_expr_method_call(self, call);
    }
}

impl SourceFile {
    /// Functions that the file, its tests excluded, asks the C library for and whose last bits differ between
    /// processors.
    pub fn elementary_calls(&self) -> Vec<String> {
        let mut calls = ElementaryCalls(Vec::new());
        calls.visit_file(&self.items);
        calls.0
    }
}

/// Figures of a house.
#[derive(Debug)]
pub struct Measures {
    /// Largest crate, and its number of lines.
    pub largest: (String, usize),
    /// Circles of files that import each other.
    pub circles: Vec<Vec<PathBuf>>,
    /// Faces that define something which their own crate imports.
    pub defining_faces: Vec<PathBuf>,
    /// Types defined, and those whose name stands for another type as well.
    pub types: (usize, Vec<String>),
    /// Doc comments, and those that open with a word that names nothing.
    pub docs: (usize, usize),
    /// Comment lines, and those wider than [`WIDTH`].
    pub comments: (usize, Vec<String>),
    /// Lines that print, by crate.
    pub printing: BTreeMap<String, usize>,
}

impl Room {
    /// Reads the crate in `folder`, a path below `root`.
    ///
    /// # Panics
    /// If a file cannot be read or is not Rust.
    pub fn read(root: &Path, folder: &Path, name: &str) -> Self {
        let source = root.join(folder).join("src");
        let mut paths = Vec::new();
        collect(&source, &mut paths);
        let file = |path: PathBuf| {
            let text = std::fs::read_to_string(&path).expect("a source file can be read");
            let inside = path.strip_prefix(&source).expect("the file lies in the folder");
            let mut module: Vec<String> =
                inside.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
            module.pop_if(|last| ["lib", "main", "mod"].contains(&last.as_str()));
            let items = syn::parse_file(&text).expect("the sources compile");
            let path = path.strip_prefix(root).expect("the folder lies in the house").to_owned();
            SourceFile { path, module, text, items }
        };
        let tests = |path: &PathBuf| path.file_name().is_some_and(|name| name == "tests.rs");
        Self { name: name.to_owned(), files: paths.into_iter().filter(|path| !tests(path)).map(file).collect() }
    }

    /// Number of lines of all sources.
    pub fn lines(&self) -> usize {
        self.files.iter().map(|file| file.text.lines().count()).sum()
    }

    /// Files that each file imports from.
    fn imports(&self) -> Vec<BTreeSet<usize>> {
        let found = |file: &SourceFile| {
            let mut imports = Imports { paths: Vec::new() };
            imports.visit_file(&file.items);
            let absolute = imports.paths.iter().filter_map(|path| absolute(&file.module, path));
            absolute.filter_map(|path| self.resolve(&path, 0)).collect::<BTreeSet<usize>>()
        };
        let files = self.files.iter().enumerate();
        files.map(|(own, file)| found(file).into_iter().filter(|&other| other != own).collect()).collect()
    }

    /// File that defines what a path of the crate names.
    fn resolve(&self, path: &[String], depth: usize) -> Option<usize> {
        let of_module = |module: &[String]| self.files.iter().position(|file| file.module == module);
        let known = (0..=path.len()).rev().find_map(|length| Some((length, of_module(&path[..length])?)));
        let (length, file) = known?;
        let Some(name) = path.get(length) else { return Some(file) };
        // A face passes names on.
        let passed_on = re_exports(&self.files[file].items).into_iter().find(|(as_name, _)| as_name == name);
        match passed_on {
            Some((_, target)) if depth < 8 => {
                let target = absolute(&self.files[file].module, &target).unwrap_or(target);
                // A bare name is a module beside the face, or another crate.
                let beside = [&self.files[file].module[..], &target].concat();
                let target = if self.begins(&target) { target } else { beside };
                if self.begins(&target) { self.resolve(&target, depth + 1) } else { None }
            }
            _ => Some(file),
        }
    }

    /// True if the path begins with a module of the crate.
    fn begins(&self, path: &[String]) -> bool {
        path.first().is_some_and(|first| self.files.iter().any(|file| file.module.first() == Some(first)))
    }

    /// Circles of files that import each other.
    pub fn circles(&self) -> Vec<Vec<PathBuf>> {
        let imports = self.imports();
        let reaches: Vec<BTreeSet<usize>> = (0..self.files.len()).map(|file| reached(&imports, file)).collect();
        let mut circles = Vec::new();
        let mut seen = BTreeSet::new();
        for file in 0..self.files.len() {
            let circle: Vec<usize> =
                reaches[file].iter().copied().filter(|&other| reaches[other].contains(&file)).collect();
            if circle.len() > 1 && seen.insert(circle.clone()) {
                circles.push(circle.iter().map(|&file| self.files[file].path.clone()).collect());
            }
        }
        circles
    }

    /// Faces (`lib.rs`, `mod.rs`) that define something which another file of the crate imports.
    pub fn defining_faces(&self) -> Vec<PathBuf> {
        let imported: BTreeSet<usize> = self.imports().into_iter().flatten().collect();
        let is_face = |file: &SourceFile| file.path.ends_with("lib.rs") || file.path.ends_with("mod.rs");
        let defines = |file: &SourceFile| file.items.items.iter().any(defines_something);
        let faces = imported.into_iter().map(|file| &self.files[file]);
        faces.filter(|file| is_face(file) && defines(file)).map(|file| file.path.clone()).collect()
    }

    /// Names of the types that the crate defines.
    fn types(&self) -> Vec<String> {
        let names = |file: &SourceFile| {
            let of_item = |item: &Item| match item {
                Item::Struct(item) => Some(item.ident.to_string()),
                Item::Enum(item) => Some(item.ident.to_string()),
                Item::Trait(item) => Some(item.ident.to_string()),
                Item::Type(item) => Some(item.ident.to_string()),
                _ => None,
            };
            file.items.items.iter().filter_map(of_item).collect::<Vec<_>>()
        };
        self.files.iter().flat_map(names).collect()
    }
}

impl Measures {
    /// Figures of the crates of a house.
    pub fn of(rooms: &[Room]) -> Self {
        let largest = rooms.iter().map(|room| (room.name.clone(), room.lines())).max_by_key(|(_, lines)| *lines);
        let all: Vec<String> = rooms.iter().flat_map(Room::types).collect();
        let mut times = BTreeMap::new();
        all.iter().for_each(|name| *times.entry(name.as_str()).or_insert(0_usize) += 1);
        let shared = all.iter().filter(|name| times[name.as_str()] > 1).cloned().collect();
        let files = || rooms.iter().flat_map(|room| &room.files);
        let (mut docs, mut comments) = ((0, 0), (0, Vec::new()));
        for file in files() {
            let mut inside = false;
            for (number, line) in file.text.lines().enumerate() {
                let trimmed = line.trim_start();
                if trimmed.starts_with("//") {
                    comments.0 += 1;
                    if line.chars().count() > WIDTH {
                        comments.1.push(format!("{}:{}", file.path.display(), number + 1));
                    }
                }
                let doc = trimmed.strip_prefix("///").or(trimmed.strip_prefix("//!"));
                if let (Some(text), false) = (doc, inside) {
                    docs.0 += 1;
                    let first = text.split_whitespace().next().unwrap_or_default();
                    docs.1 += usize::from(OPENERS.contains(&first));
                }
                inside = doc.is_some();
            }
        }
        let prints = |line: &str| {
            let code = line.split("//").next().unwrap_or_default();
            ["println!(", "eprintln!(", "print!(", "eprint!("].iter().any(|call| code.contains(call))
        };
        let printing = |room: &Room| {
            let lines = room.files.iter().flat_map(|file| file.text.lines()).filter(|line| prints(line));
            (room.name.clone(), lines.count())
        };
        Self {
            largest: largest.unwrap_or_default(),
            circles: rooms.iter().flat_map(Room::circles).collect(),
            defining_faces: rooms.iter().flat_map(Room::defining_faces).collect(),
            types: (all.len(), shared),
            docs,
            comments,
            printing: rooms.iter().map(printing).filter(|(_, lines)| *lines > 0).collect(),
        }
    }
}

/// Rust files below a folder, in order.
fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a folder can be listed").path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            collect(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// Files that can be reached from a file by imports, itself included if a way leads back.
fn reached(imports: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<usize> = imports[from].iter().copied().collect();
    while let Some(file) = next.pop() {
        if reached.insert(file) {
            next.extend(&imports[file]);
        }
    }
    reached
}

/// Path from the crate's root of a path in a module; `None` if it leads to another crate.
fn absolute(module: &[String], path: &[String]) -> Option<Vec<String>> {
    let mut base = module.to_vec();
    let mut rest = path;
    match path.first()?.as_str() {
        "crate" => return Some(path[1..].to_vec()),
        "self" => rest = &path[1..],
        "super" => {
            while rest.first().is_some_and(|part| part == "super") {
                base.pop();
                rest = &rest[1..];
            }
        }
        _ => return None,
    }
    base.extend_from_slice(rest);
    Some(base)
}

/// Names that a file passes on by `pub use`, each with the path that it comes from.
fn re_exports(file: &File) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for item in &file.items {
        if let Item::Use(ItemUse { tree, vis, .. }) = item
            && !matches!(vis, Visibility::Inherited)
        {
            leaves(tree, &mut Vec::new(), &mut |path, name| found.push((name.to_owned(), path.to_vec())));
        }
    }
    found
}

/// Calls `found` with the full path and the name of every leaf of a tree of imports.
fn leaves(tree: &UseTree, before: &mut Vec<String>, found: &mut dyn FnMut(&[String], &str)) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            leaves(&path.tree, before, found);
            before.pop();
        }
        UseTree::Group(group) => group.items.iter().for_each(|item| leaves(item, before, found)),
        UseTree::Name(name) if name.ident == "self" => {
            let own = before.clone();
            found(&own, own.last().map_or("self", String::as_str));
        }
        UseTree::Name(name) => {
            let path = [before.as_slice(), &[name.ident.to_string()]].concat();
            found(&path, &name.ident.to_string());
        }
        UseTree::Rename(rename) => {
            let path = [before.as_slice(), &[rename.ident.to_string()]].concat();
            found(&path, &rename.rename.to_string());
        }
        UseTree::Glob(_) => found(&before.clone(), "*"),
    }
}

/// True if code after this attribute is compiled for tests alone.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.meta.require_list().is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

/// True if an item of a face is more than a module, an import or an attribute.
fn defines_something(item: &Item) -> bool {
    match item {
        Item::Use(_) | Item::ExternCrate(_) | Item::Macro(_) => false,
        Item::Mod(ItemMod { content, .. }) => {
            content.is_some() && !matches!(item, Item::Mod(module) if is_test(&module.attrs))
        }
        _ => true,
    }
}

/// Paths into the own crate, tests excluded.
struct Imports {
    paths: Vec<Vec<String>>,
}

impl<'ast> Visit<'ast> for Imports {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        if !is_test(&item.attrs) {
            leaves(&item.tree, &mut Vec::new(), &mut |path, _| self.paths.push(path.to_vec()));
        }
    }

    fn visit_visibility(&mut self, _visibility: &'ast Visibility) {
        // `pub(in crate::a)` imports nothing.
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if segments.len() > 1 {
            self.paths.push(segments);
        }
        visit::visit_path(self, path);
    }
}
