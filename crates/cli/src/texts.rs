//! Program texts on disk: files, standard input spooled to a temporary file, subprograms by their number.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use base::SourceId;
use meaning::WINDOW;
use station::{Library, LibraryError, Shelf, Wanted};
use tape::{Codes, Format, IGNORED, UNREADABLE, recognise};

use crate::failure::Failure;

/// Endings under which a subprogram's file is looked for; none is tried first.
const ENDINGS: &[&str] = &["", "nc", "cnc", "tap", "eia", "txt"];

struct Source {
    /// The name as the user gave it.
    name: String,
    file: File,
    /// Where the file is read next without seeking.
    at: u64,
    /// What of a stream (standard input, a pipe) has not been spooled yet.
    rest: Option<Box<dyn Read>>,
    /// Bytes of the file known to exist.
    length: u64,
    /// Text or tape, once that was asked for.
    format: Option<Format>,
}

/// The texts.
pub struct Texts {
    sources: Vec<Source>,
    folders: Vec<PathBuf>,
    /// Programs in the control's memory, by their numbers and by their files' names in capitals.
    memory: BTreeMap<u32, SourceId>,
    memory_files: BTreeMap<String, SourceId>,
    /// The codes of the control's tapes, if it reads any.
    codes: Option<Codes>,
    /// Where files to load are looked for that are not found from here.
    beside: Option<PathBuf>,
    /// What is loaded into memory is copied: the file may then change.
    copies: bool,
}

impl Texts {
    /// No texts yet; subprograms are looked up in these folders, in their order.
    pub fn new(folders: Vec<PathBuf>) -> Texts {
        let (memory, memory_files) = Default::default();
        Texts { sources: Vec::new(), folders, memory, memory_files, codes: None, beside: None, copies: false }
    }

    /// Images of tapes are shown in these codes.
    pub fn show_tapes(&mut self, codes: Option<Codes>) {
        self.codes = codes;
    }

    /// Opens a program, `-` for standard input.
    pub fn open(&mut self, name: &str) -> Result<SourceId, Failure> {
        self.opened(name).map_err(Failure::call)
    }

    fn opened(&mut self, name: &str) -> Result<SourceId, String> {
        if name == "-" {
            return self.spooled("<stdin>", Box::new(io::stdin()));
        }
        let cannot = |error: io::Error| format!("cannot read {name}: {error}");
        let file = File::open(name).map_err(cannot)?;
        let facts = file.metadata().map_err(cannot)?;
        if facts.is_dir() {
            return Err(format!("cannot read {name}: it is a folder"));
        }
        if !facts.is_file() {
            // A pipe or device cannot be read at any place: it is a stream like standard input.
            return self.spooled(name, Box::new(file));
        }
        let mut head = Vec::new();
        (&file).take(2).read_to_end(&mut head).map_err(cannot)?;
        one_byte_a_character(name, &head)?;
        let at = head.len() as u64;
        Ok(self.push(Source { name: name.to_owned(), file, at, rest: None, length: facts.len(), format: None }))
    }

    /// Opens a file that is shown under another name.
    pub fn open_as(&mut self, file: &str, name: &str) -> Result<SourceId, Failure> {
        let source = self.open(file)?;
        if let Some(source) = self.sources.get_mut(source.0 as usize) {
            source.name = name.to_owned();
        }
        Ok(source)
    }

    /// A text that is not in a file under this name, or not yet.
    pub fn hold(&mut self, name: &str, bytes: Vec<u8>) -> Result<SourceId, Failure> {
        self.written(name, bytes).map_err(Failure::call)
    }

    /// A text at hand, in a temporary file.
    fn written(&mut self, name: &str, bytes: Vec<u8>) -> Result<SourceId, String> {
        let source = self.spooled(name, Box::new(io::Cursor::new(bytes)))?;
        let spooled = self.sources.last_mut().map_or(Ok(()), |source| source.spool(u64::MAX));
        spooled.map_err(|error| format!("no room to spool {name}: {error}"))?;
        Ok(source)
    }

    /// A stream, which is written to a temporary file as far as it is read.
    fn spooled(&mut self, name: &str, stream: Box<dyn Read>) -> Result<SourceId, String> {
        let file = tempfile::tempfile().map_err(|e| format!("no room to spool {name}: {e}"))?;
        Ok(self.push(Source { name: name.to_owned(), file, at: 0, rest: Some(stream), length: 0, format: None }))
    }

    /// Files to load that are not found from here are looked for in this folder.
    pub fn load_beside(&mut self, folder: PathBuf) {
        self.beside = Some(folder);
    }

    /// What is loaded from now on is copied.
    pub fn copy_loaded(&mut self) {
        self.copies = true;
    }

    /// All bytes of a source.
    pub fn bytes_of(&mut self, source: SourceId) -> Result<Vec<u8>, LibraryError> {
        let (mut bytes, mut window) = (Vec::new(), Vec::new());
        loop {
            let last = self.read(source, bytes.len() as u64, 1 << 20, &mut window)?;
            bytes.extend_from_slice(&window);
            if last || window.is_empty() {
                return Ok(bytes);
            }
        }
    }

    /// The ending of the file that a program in memory is, on a control whose programs are files.
    pub fn ending_of(&self, source: SourceId) -> Option<&str> {
        let name = self.memory_files.iter().find(|(_, own)| **own == source).map(|(name, _)| name)?;
        name.rsplit_once('.').map(|(_, ending)| ending)
    }

    /// Subprograms are looked up beside this file too.
    fn look_beside(&mut self, file: &str) {
        let folder = folder_of(file);
        if !self.folders.contains(&folder) {
            self.folders.push(folder);
        }
    }

    fn push(&mut self, source: Source) -> SourceId {
        self.sources.push(source);
        SourceId((self.sources.len() - 1) as u32)
    }

    /// The name of a source as the user gave it.
    pub fn name(&self, source: SourceId) -> &str {
        self.sources.get(source.0 as usize).map_or("?", |source| source.name.as_str())
    }

    /// How long a source is, as far as that is known.
    pub fn length(&self, source: SourceId) -> u64 {
        self.sources.get(source.0 as usize).map_or(0, |source| source.length)
    }

    /// Characters of a source for showing them, one for each byte; what cannot be read is left out.
    pub fn excerpt(&mut self, source: SourceId, offset: u64, len: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        if let (Some(codes), Some(Format::Tape(tape))) = (self.codes, self.format(source)) {
            let _ = self.read(source, offset, len, &mut bytes);
            Format::Tape(tape).translate(&codes, &mut bytes, offset, true);
            readable(&mut bytes);
            return bytes;
        }
        let _ = self.read(source, offset, len, &mut bytes);
        bytes
    }

    /// True if a source is the image of a tape.
    pub fn is_tape(&mut self, source: SourceId) -> bool {
        matches!(self.format(source), Some(Format::Tape(_)))
    }

    /// How a source is read: text or tape.
    fn format(&mut self, source: SourceId) -> Option<Format> {
        let codes = self.codes?;
        let known = self.sources.get(source.0 as usize)?.format;
        known.or_else(|| {
            let mut head = Vec::new();
            let _ = self.read(source, 0, WINDOW, &mut head);
            let format = recognise(&head, &codes);
            self.sources.get_mut(source.0 as usize)?.format = Some(format);
            Some(format)
        })
    }

    /// The name that a program has unless an O word gives it one.
    pub fn program_name(file: &str) -> String {
        match file {
            "-" => "stdin".to_owned(),
            _ => {
                Path::new(file).file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
            }
        }
    }
}

impl Source {
    /// Spools standard input until the file holds `end` bytes or the input has ended.
    fn spool(&mut self, end: u64) -> io::Result<()> {
        let Some(input) = self.rest.as_mut() else { return Ok(()) };
        let mut chunk = [0u8; 16 * 1024];
        while self.length < end {
            let count = match input.read(&mut chunk) {
                Ok(count) => count,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            if count == 0 {
                self.rest = None;
                break;
            }
            self.file.seek(SeekFrom::Start(self.length))?;
            self.file.write_all(&chunk[..count])?;
            self.length += count as u64;
            self.at = self.length;
        }
        Ok(())
    }

    fn read(&mut self, offset: u64, len: usize, bytes: &mut Vec<u8>) -> io::Result<bool> {
        self.spool(offset + len as u64 + 1)?;
        bytes.clear();
        if self.at != offset {
            self.file.seek(SeekFrom::Start(offset))?;
        }
        let taken = Read::by_ref(&mut self.file).take(len as u64).read_to_end(bytes)?;
        self.at = offset + taken as u64;
        Ok(taken < len || (self.rest.is_none() && self.at >= self.length && self.is_at_end()?))
    }

    /// A file may have grown since it was opened.
    fn is_at_end(&mut self) -> io::Result<bool> {
        Ok(self.file.metadata()?.len() <= self.at)
    }
}

impl Library for Texts {
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError> {
        let Some(source) = self.sources.get_mut(source.0 as usize) else {
            bytes.clear();
            return Ok(true);
        };
        source.read(offset, len, bytes).map_err(|error| LibraryError(format!("cannot read {}: {error}", source.name)))
    }

    fn find_program(&mut self, wanted: Wanted) -> Result<Option<SourceId>, LibraryError> {
        let known = match wanted {
            Wanted::Number(number, ending) => {
                let file = || self.memory_files.get(&format!("O{number}.{}", ending.to_uppercase()));
                self.memory.get(&number).or_else(file)
            }
            Wanted::File(name) => self.memory_files.get(name),
        };
        if let Some(&source) = known {
            return Ok(Some(source));
        }
        for folder in self.folders.clone() {
            let path = match wanted {
                Wanted::Number(number, ending) => find_file(&folder, number, ending),
                Wanted::File(name) => find_name(&folder, name),
            };
            let Some(path) = path else { continue };
            let name = path.to_string_lossy().into_owned();
            if let Some(index) = self.sources.iter().position(|source| source.name == name) {
                return Ok(Some(SourceId(index as u32)));
            }
            return match self.open(&name) {
                Ok(source) => Ok(Some(source)),
                Err(_) => Err(LibraryError(format!("cannot read {name}"))),
            };
        }
        Ok(None)
    }

    fn size(&self, source: SourceId) -> Option<u64> {
        let source = self.sources.get(source.0 as usize)?;
        // Of a stream it is known once that has been read to its end.
        source.rest.is_none().then_some(source.length)
    }

    fn file_name(&self, source: SourceId) -> Option<String> {
        self.sources.get(source.0 as usize).map(|source| Texts::program_name(&source.name))
    }
}

impl Shelf for Texts {
    fn open_file(&mut self, file: &str) -> Result<(SourceId, String), LibraryError> {
        let beside = self.beside.as_ref().map(|folder| folder.join(file));
        let path = match beside {
            Some(beside) if !Path::new(file).exists() && beside.exists() => beside.to_string_lossy().into_owned(),
            _ => file.to_owned(),
        };
        let mut source = self.opened(&path).map_err(LibraryError)?;
        if self.copies {
            let bytes = self.bytes_of(source)?;
            source = self.written(&path, bytes).map_err(LibraryError)?;
        }
        self.look_beside(&path);
        Ok((source, Texts::program_name(file)))
    }

    fn keep_in_memory(&mut self, program: Wanted, source: SourceId) {
        match program {
            Wanted::Number(number, _) => drop(self.memory.insert(number, source)),
            Wanted::File(name) => drop(self.memory_files.insert(name.to_owned(), source)),
        }
    }

    fn forget_in_memory(&mut self, program: Wanted) {
        match program {
            Wanted::Number(number, _) => drop(self.memory.remove(&number)),
            Wanted::File(name) => drop(self.memory_files.remove(name)),
        }
    }

    fn hold_text(&mut self, name: &str, text: Vec<u8>) -> Result<SourceId, LibraryError> {
        self.written(name, text).map_err(LibraryError)
    }
}

/// A tape's characters as people read them, up to the end of the block: rows that are passed over leave a blank, those
/// that cannot be read a question mark.
pub fn readable(characters: &mut Vec<u8>) {
    let end = characters.iter().position(|&c| c == tape::END_OF_BLOCK).unwrap_or(characters.len());
    let said = characters[..end].iter().rposition(|&c| c != IGNORED).map_or(0, |last| last + 1);
    characters.truncate(said);
    for character in characters {
        match *character {
            IGNORED => *character = b' ',
            UNREADABLE => *character = b'?',
            _ => {}
        }
    }
}

/// Refuses a text of two bytes a character by its mark: its lines and columns would be counted wrong.
pub fn one_byte_a_character(name: &str, bytes: &[u8]) -> Result<(), String> {
    match bytes {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => {
            Err(format!("{name}: a text of two bytes a character; save it as plain text first"))
        }
        _ => Ok(()),
    }
}

/// The folder a file stands in.
pub fn folder_of(file: &str) -> PathBuf {
    let folder = Path::new(file).parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.map_or_else(|| PathBuf::from("."), Path::to_path_buf)
}

/// The file of this name in a folder, whatever the case of its letters; the very name first.
fn find_name(folder: &Path, wanted: &str) -> Option<PathBuf> {
    let is_it = |name: &str| name.eq_ignore_ascii_case(wanted);
    let paths = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    let named = |path: &PathBuf| path.file_name().and_then(|name| name.to_str()).is_some_and(is_it);
    // Capitals stand before small letters: of two files that differ in case alone the one in capitals is taken.
    paths.filter(|path| named(path) && path.is_file()).min()
}

/// The file of a program number in a folder: `O4321` with any of the endings, this one first, in any case of letters.
fn find_file(folder: &Path, number: u32, first: &str) -> Option<PathBuf> {
    let mut found: Vec<(usize, PathBuf)> = Vec::new();
    for entry in fs::read_dir(folder).ok()?.flatten() {
        let path = entry.path();
        let stem = path.file_stem()?.to_str().unwrap_or_default();
        let digits = stem.strip_prefix(['O', 'o']).unwrap_or_default();
        let is_number =
            !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()) && digits.parse() == Ok(number);
        let ending = path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase());
        if let (true, Some(rank)) = (is_number, ENDINGS.iter().position(|known| *known == ending))
            && path.is_file()
        {
            let rank = if ending.eq_ignore_ascii_case(first) { 0 } else { rank + 1 };
            found.push((rank, path));
        }
    }
    found.sort();
    found.into_iter().next().map(|(_, path)| path)
}

/// True for files that are programs by their name: one of the endings, or `O` and digits.
pub fn looks_like_program(path: &Path) -> bool {
    let ending = path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase());
    if ending.is_empty() {
        let stem = path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
        let digits = stem.strip_prefix(['O', 'o']).unwrap_or_default();
        return !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    }
    ENDINGS.contains(&ending.as_str())
}
