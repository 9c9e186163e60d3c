// Names of projects: what the server takes for the name of a folder, and a sentence where it does not.

const LONGEST = 80; // characters
const LONGEST_BYTES = 200; // of UTF-8

// As it is sent: an accent and its letter are one character where there is one.
export const projectName = (typed: string): string => typed.normalize("NFC").trim();

// Empty: the name is good. `taken`: the names of the folder, with their endings.
export function nameProblem(name: string, taken: readonly string[]): string {
  if (name === "") return "Give the project a name.";
  if (!/^[\p{L}\p{N}]/u.test(name)) return "Let the name begin with a letter or a digit.";
  const wrong = /[^\p{L}\p{N}\p{M} ._-]|\p{Default_Ignorable_Code_Point}/u.exec(name);
  if (wrong) return `Leave out ${shown(wrong[0])}: a name has letters, digits, spaces, full stops, _ and -.`;
  if ([...name].length > LONGEST || new TextEncoder().encode(name).length > LONGEST_BYTES) return "Give the project a shorter name.";
  if (taken.some((one) => one === `${name}.qch`)) return "A project of this name is there already.";
  return "";
}

const shown = (character: string): string =>
  /^[\p{P}\p{S}]$/u.test(character) ? `“${character}”` : `the character U+${character.codePointAt(0)!.toString(16).toUpperCase().padStart(4, "0")}`;
