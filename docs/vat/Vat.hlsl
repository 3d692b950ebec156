// Unity's Shader Graph: where a vertex of `shoal export --vat` is at a time (docs/vat.md).
// `column`: x of the mesh's second texture coordinates. `time`: frames.

float4 VatBetween(Texture2D tex, int column, int row, int next, float share)
{
    return lerp(tex.Load(int3(column, row, 0)), tex.Load(int3(column, next, 0)), share);
}

float3 VatRotated(float4 q, float3 v)
{
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

// In glTF's axes: right-handed, Y up, metres. Unity's importer of glTF turns x over: give it float3(-1, 1, 1) as `axes`,
// and turn the results over alike.
void Vat_float(UnityTexture2D tex, float column, float time, float frames, float3 low, float3 high, bool rigid,
               float3 restPosition, float3 restNormal, float3 axes, out float3 position, out float3 normal)
{
    float width, height;
    tex.tex.GetDimensions(width, height);
    int c = int(column * width);
    float at = fmod(time, frames);
    int now = int(at);
    int next = (now + 1) % int(frames);
    float3 place = low + VatBetween(tex.tex, c, now, next, frac(at)).rgb * (high - low);
    float4 turn = VatBetween(tex.tex, c, int(frames) + now, int(frames) + next, frac(at)) * 2.0 - 1.0;
    float3 p = restPosition * axes;
    float3 n = restNormal * axes;
    if (rigid) {
        turn = normalize(turn);
        p = place + VatRotated(turn, p);
        n = VatRotated(turn, n);
    } else {
        p += float3(place.x, place.z, -place.y);
        n = normalize(float3(turn.x, turn.z, -turn.y));
    }
    position = p * axes;
    normal = n * axes;
}
