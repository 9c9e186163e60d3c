// The order of evaluated planes while a weight moves: the weighted sum of the terms that the engine gave. Provisional, because
// the engine may find other planes with other weights.

import type { PlaneDocument, Terms } from "../link/documents";

export interface RankedPlane {
  plane: PlaneDocument;
  total: number;
}

export const isTerm = (key: string): boolean => key !== "total";

// The names of the terms in the order of the documents.
export const termsOf = (weights: Terms): string[] => Object.keys(weights).filter(isTerm);

export function totalOf(terms: Terms, weights: Terms): number {
  return termsOf(weights).reduce((sum, name) => sum + weights[name]! * (terms[name] ?? 0), 0);
}

export const areSame = (a: Terms, b: Terms): boolean =>
  [...new Set([...Object.keys(a), ...Object.keys(b)])].every((name) => (a[name] ?? 0) === (b[name] ?? 0));

// Planes with the least total first. With the weights that the engine ranked by, its own order and totals stay as they are.
export function ranked(planes: PlaneDocument[], weights: Terms, rankedBy: Terms): RankedPlane[] {
  if (areSame(weights, rankedBy)) return planes.map((plane) => ({ plane, total: plane.terms["total"] ?? 0 }));
  return planes
    .map((plane) => ({ plane, total: totalOf(plane.terms, weights) }))
    .sort((a, b) => a.total - b.total || (a.plane.k ?? 0) - (b.plane.k ?? 0));
}
